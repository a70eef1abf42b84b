#include "azulejo/imaging/equalize.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/equalize_tables.h"

namespace azulejo {
namespace {

class Equalize final : public TileNode {
 public:
  Equalize(const EqualizeOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    set_results({sources[0]});
  }

  std::unique_ptr<Analysis> analysis(int) const override {
    return visit_type(sources()[0].type, [&](auto zero) -> std::unique_ptr<Analysis> {
      return std::make_unique<EqualizeTables<decltype(zero)>>(sources()[0], options_.per_channel);
    });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      map_values(analysis_of<decltype(zero)>(context.analyses).tables(), from[0].pixels, results[0].pixels);
    });
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      map_values_reference(analysis_of<decltype(zero)>(context.analyses).tables(), from[0].pixels, results[0].pixels);
    });
  }

  void report_stages(std::span<const Analysis* const> analyses, const StageReporter& reporter) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      const auto& analysis = analysis_of<decltype(zero)>(analyses);
      report_tables(analysis.tables(), analysis.counts(), reporter);
    });
  }

 private:
  template <class T>
  static const EqualizeTables<T>& analysis_of(std::span<const Analysis* const> analyses) {
    return static_cast<const EqualizeTables<T>&>(*analyses[0]);
  }

  EqualizeOptions options_;
};

}  // namespace

extern const Operation kEqualize = with_examples(
    image_operation<EqualizeOptions, Equalize>(
        "equalize", "Spreads intensities so that each is about as frequent.", {{"source", "the image"}},
        {{"equalized", "the same with an even histogram"}},
        {field("per_channel", &EqualizeOptions::per_channel, "a table for each color channel instead of one for all")}),
    {{"dark.png equalize", "An under-exposed picture uses the whole range; noise of its dark parts shows."},
     {"dark.png equalize:per_channel=true", "Each channel by itself: a color cast goes, and hues change."}});

void equalize(const ConstAnyView& source, const AnyView& result, const EqualizeOptions& options, const Run& run) {
  apply_into(kEqualize, &options, {source}, {result}, run);
}

Image equalize(const Image& source, const EqualizeOptions& options, const Run& run) {
  return std::move(apply(kEqualize, &options, {&source}, run)[0]);
}

}  // namespace azulejo
