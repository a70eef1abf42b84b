#include "azulejo/io/image_source.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "azulejo/io/decode_pass.h"

namespace azulejo {
namespace {

class PassReader final : public RowReader {
 public:
  explicit PassReader(std::unique_ptr<DecodePass> pass) : pass_(std::move(pass)) {}

  void read(int y, const AnyView& rows) override {
    skip_to(y);
    pass_->read(rows);
    next_ += rows.height();
  }

 private:
  void skip_to(int y) {
    if (next_ >= y) return;
    ImageInfo info = pass_->file().info;
    info.height = std::min(y - next_, std::max(16, pass_->row_group()));
    Image skipped(info);
    while (next_ < y) {
      const int count = std::min(info.height, y - next_);
      pass_->read(skipped.any().crop({0, 0, info.width, count}));
      next_ += count;
    }
  }

  std::unique_ptr<DecodePass> pass_;
  int next_ = 0;
};

class ImageReader final : public RowReader {
 public:
  explicit ImageReader(std::shared_ptr<const Image> image) : image_(std::move(image)) {}
  void read(int y, const AnyView& rows) override {
    copy_pixels(image_->any().crop({0, y, rows.width(), rows.height()}), rows);
  }

 private:
  std::shared_ptr<const Image> image_;
};

class FileSource final : public ImageSource {
 public:
  FileSource(std::shared_ptr<const Input> input, ReadOptions options, const Run& run)
      : input_(std::move(input)), options_(std::move(options)), said_(std::make_shared<std::set<std::string>>()) {
    const auto pass = new_pass(run);
    file_ = pass->file();
    row_group_ = pass->row_group();
  }

  const ImageInfo& info() const override { return file_.info; }
  const Metadata& metadata() const override { return file_.metadata; }
  const Image* image() const override { return in_memory_ ? whole_.get() : nullptr; }
  int row_group() const override { return file_.streamed ? row_group_ : 1; }

  std::unique_ptr<RowReader> rows(const Run& run) override {
    if (file_.streamed) return std::make_unique<PassReader>(new_pass(run));
    if (!whole_) {
      whole_ = std::make_shared<const Image>(new_pass(run)->decode_whole());
      in_memory_ = image_bytes(file_.info) <= run.limits.memory_bytes;
    }
    return std::make_unique<ImageReader>(whole_);
  }

 private:
  /// A pass that warns of nothing that an earlier one has warned of.
  std::unique_ptr<DecodePass> new_pass(const Run& run) {
    Run once = run;
    if (run.warn) {
      once.warn = [said = said_, warn = run.warn](const std::string& line) {
        if (said->insert(line).second) warn(line);
      };
    }
    return std::make_unique<DecodePass>(input_, options_, once);
  }

  std::shared_ptr<const Input> input_;
  ReadOptions options_;
  std::shared_ptr<std::set<std::string>> said_;
  ImageFile file_;
  int row_group_ = 1;
  std::shared_ptr<const Image> whole_;
  bool in_memory_ = false;
};

}  // namespace

std::unique_ptr<ImageSource> open_file_source(std::shared_ptr<const Input> input, const ReadOptions& options,
                                              const Run& run) {
  return std::make_unique<FileSource>(std::move(input), options, run);
}

}  // namespace azulejo
