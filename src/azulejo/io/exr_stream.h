#pragma once

#include <ImfIO.h>

#include <exception>
#include <memory>

#include "azulejo/core/error.h"
#include "azulejo/io/byte_reader.h"
#include "azulejo/io/input.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// An Input as OpenEXR wants it. OpenEXR turns exceptions of its streams into its own: `failure` keeps the first
/// one, so that the caller can throw it on.
class ExrInputStream : public Imf::IStream {
 public:
  explicit ExrInputStream(const std::shared_ptr<const Input>& input) : IStream(input->name().c_str()), reader_(input) {}
  bool read(char bytes[], int count) override;
  std::uint64_t tellg() override { return reader_.position(); }
  void seekg(std::uint64_t position) override { reader_.seek(position); }
  const std::exception_ptr& failure() const { return failure_; }

 private:
  ByteReader reader_;
  std::exception_ptr failure_;
};

/// An Output as OpenEXR wants it; the same about exceptions.
class ExrOutputStream : public Imf::OStream {
 public:
  explicit ExrOutputStream(Output& output) : OStream(output.name().c_str()), output_(output) {}
  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return output_.position(); }
  void seekp(std::uint64_t position) override;
  const std::exception_ptr& failure() const { return failure_; }

 private:
  Output& output_;
  std::exception_ptr failure_;
};

/// Throws Error(Data) or Error(Resource) where the attributes of a file's headers claim sizes that the file does
/// not have: OpenEXR allocates before it reads.
void check_exr_attributes(const std::shared_ptr<const Input>& input);

/// The exception that is being handled, as an Error that begins with the file's name.
/// Call it in a catch block; `failure` is the stream's.
[[noreturn]] void rethrow_exr_error(const std::string& name, const std::exception_ptr& failure);

}  // namespace azulejo
