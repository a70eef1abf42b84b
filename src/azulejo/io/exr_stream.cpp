#include "azulejo/io/exr_stream.h"

#include <Iex.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <span>
#include <string>

namespace azulejo {
namespace {

constexpr std::size_t kLongestName = 255;

std::string attribute_string(ByteReader& reader) {
  std::string text;
  while (const char c = static_cast<char>(reader.byte())) {
    if (text.size() == kLongestName) throw reader.error(Error::Data, "a name of more than 255 characters");
    text += c;
  }
  return text;
}

/// The one attribute type whose inner sizes OpenEXR takes on trust.
void check_string_vector(ByteReader& reader, std::uint64_t end) {
  while (reader.position() < end) {
    const std::uint64_t size = reader.le32();
    if (size > end - std::min(end, reader.position())) throw reader.error(Error::Data, "a string longer than its list");
    reader.skip(size);
  }
}

/// One header: attributes up to an empty name. False if it has none.
bool check_header(ByteReader& reader) {
  for (bool any = false;; any = true) {
    if (attribute_string(reader).empty()) return any;
    const std::string type = attribute_string(reader);
    const std::uint64_t size = reader.le32();
    const std::uint64_t end = reader.position() + size;
    if (end > reader.size()) {
      throw reader.error(Error::Data, fmt::format("an attribute of {} bytes in a file of {}", size, reader.size()));
    }
    if (type == "stringvector") check_string_vector(reader, end);
    reader.seek(end);
  }
}

/// Names of channels and parts come from the file and may hold anything.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, '?');
  return text;
}

}  // namespace

bool ExrInputStream::read(char bytes[], int count) {
  try {
    if (count < 0) throw reader_.error(Error::Data, "a negative size");
    reader_.read(std::as_writable_bytes(std::span(bytes, static_cast<std::size_t>(count))));
  } catch (const Error& problem) {
    // An early end is OpenEXR's to judge: it looks for the rows that are there.
    if (!failure_ && problem.kind() != Error::Data) failure_ = std::current_exception();
    throw;
  }
  return !reader_.at_end();
}

void ExrOutputStream::write(const char bytes[], int count) {
  try {
    output_.write(std::as_bytes(std::span(bytes, static_cast<std::size_t>(count))));
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
    throw;
  }
}

void ExrOutputStream::seekp(std::uint64_t position) {
  try {
    output_.seek(position);
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
    throw;
  }
}

void check_exr_attributes(const std::shared_ptr<const Input>& input) {
  ByteReader reader(input);
  if (reader.le32() != static_cast<std::uint32_t>(Imf::MAGIC)) throw reader.error(Error::Data, "not an OpenEXR file");
  const int version = static_cast<int>(reader.le32());
  if (Imf::getVersion(version) != Imf::EXR_VERSION || !Imf::supportsFlags(Imf::getFlags(version))) {
    throw Error(Error::Unsupported, fmt::format("{}: OpenEXR version {:#x}", input->name(), version));
  }
  if (!check_header(reader)) throw reader.error(Error::Data, "a header without attributes");
  if (Imf::isMultiPart(version)) {
    while (check_header(reader)) {
    }
  }
}

void rethrow_exr_error(const std::string& name, const std::exception_ptr& failure) {
  if (failure) std::rethrow_exception(failure);
  try {
    throw;
  } catch (const Error& problem) {
    throw Error(problem.kind(), one_line(problem.what()));
  } catch (const std::bad_alloc&) {
    throw Error(Error::Resource, fmt::format("{}: no memory left", name));
  } catch (const std::exception& problem) {
    // OpenEXR's own messages begin with the file's name, too.
    const std::string what = problem.what();
    const std::size_t quote = what.find("\". ");
    throw Error(Error::Data, one_line(fmt::format("{}: {}", name, quote == what.npos ? what : what.substr(quote + 3))));
  }
}

}  // namespace azulejo
