#include "azulejo/io/exr_channels.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::string_view kOrder = "RGBXYZWUV";  // of channels that aren't colours; others follow by name, A is last

/// Last parts of the names of the channels that begin with `prefix` and have no further dot.
std::set<std::string> names_in(const Imf::ChannelList& list, const std::string& prefix) {
  std::set<std::string> result;
  for (auto at = list.begin(); at != list.end(); ++at) {
    const std::string name = at.name();
    if (name.size() > prefix.size() && name.starts_with(prefix) && name.find('.', prefix.size()) == std::string::npos) {
      result.insert(name.substr(prefix.size()));
    }
  }
  return result;
}

std::set<std::string> layer_names(const Imf::Header& header) {
  std::set<std::string> layers;
  header.channels().layers(layers);
  std::erase_if(layers, [&](const std::string& each) { return names_in(header.channels(), each + ".").empty(); });
  return layers;
}

std::size_t rank(const std::string& name) {
  if (name == "A") return kOrder.size() + 1;
  return name.size() == 1 ? std::min(kOrder.find(name[0]), kOrder.size()) : kOrder.size();
}

/// The channels of one layer, in order, with what they mean.
ExrChoice choose_in_layer(const Imf::Header& header, int part, const std::string& prefix) {
  const std::set<std::string> names = names_in(header.channels(), prefix);
  const auto has = [&](const char* name) { return names.contains(name); };
  ExrChoice choice{.part = part, .prefix = prefix};
  std::vector<std::string> chosen;
  if (has("R") && has("G") && has("B")) {
    chosen = {"R", "G", "B"};
  } else if (has("Y") && has("RY") && has("BY")) {
    chosen = {"Y", "RY", "BY"};
    choice.chroma = true;
  } else if (has("Y") && !has("X")) {
    chosen = {"Y"};
  } else {
    choice.color = ColorState::Data;
    chosen.assign(names.begin(), names.end());
    std::stable_sort(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) { return rank(a) < rank(b); });
  }
  if (choice.color == ColorState::Linear && has("A")) {
    chosen.emplace_back("A");
    choice.alpha = AlphaState::Premultiplied;
  }
  for (const std::string& each : chosen) choice.channels.push_back(prefix + each);
  return choice;
}

/// What `layer` means in one part; the empty layer is the part's main one.
std::optional<ExrChoice> find_in_part(const Imf::Header& header, int part, const std::string& layer) {
  if (!layer.empty()) {
    if (!names_in(header.channels(), layer + ".").empty()) return choose_in_layer(header, part, layer + ".");
    if (header.channels().findChannel(layer) != nullptr) {
      return ExrChoice{.part = part, .channels = {layer}, .color = ColorState::Data};
    }
    return std::nullopt;
  }
  if (!names_in(header.channels(), "").empty()) return choose_in_layer(header, part, "");
  const std::set<std::string> layers = layer_names(header);
  if (layers.empty()) return std::nullopt;
  // A part that is named like one of its layers means that layer.
  const std::string& main =
      header.hasName() && layers.contains(header.name()) ? *layers.find(header.name()) : *layers.begin();
  return choose_in_layer(header, part, main + ".");
}

std::optional<ExrChoice> find_anywhere(const Imf::MultiPartInputFile& file, const std::string& layer) {
  if (layer.empty()) return find_in_part(file.header(0), 0, layer);
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    std::optional<ExrChoice> found;
    if (header.hasName() && layer == header.name()) {
      found = find_in_part(header, part, "");
    } else if (header.hasName() && layer.starts_with(header.name() + ".")) {
      found = find_in_part(header, part, layer.substr(header.name().size() + 1));
    }
    if (!found) found = find_in_part(header, part, layer);
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace

ExrChoice choose_exr_channels(const Imf::MultiPartInputFile& file, const std::string& layer, const std::string& name,
                              const Run& run) {
  const std::optional<ExrChoice> found = find_anywhere(file, layer);
  if (!found && layer.empty()) throw Error(Error::Data, fmt::format("{}: no channels", name));
  if (!found) {
    throw Error(Error::Argument,
                fmt::format("{}: layer \"{}\": the file has {}", name, layer, fmt::join(exr_layers(file), ", ")));
  }
  if (found->channels.size() > 4) {
    throw Error(Error::Unsupported, fmt::format("{}: {} channels ({}); name one of them as the layer", name,
                                                found->channels.size(), fmt::join(found->channels, ", ")));
  }
  if (layer.empty() && !found->prefix.empty() && layer_names(file.header(0)).size() > 1) {
    warn(run, fmt::format("{}: no main image, reading layer \"{}\" of {}", name,
                          found->prefix.substr(0, found->prefix.size() - 1), fmt::join(exr_layers(file), ", ")));
  }
  return *found;
}

std::vector<std::string> exr_layers(const Imf::MultiPartInputFile& file) {
  std::vector<std::string> result;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    const bool named = file.parts() > 1 && header.hasName();
    if (named) result.push_back(header.name());
    for (const std::string& layer : layer_names(header)) {
      result.push_back(named ? header.name() + "." + layer : layer);
    }
    // Channels beside the main image are read by their name.
    const auto main = find_in_part(header, part, "");
    for (const std::string& each : names_in(header.channels(), "")) {
      if (main && std::find(main->channels.begin(), main->channels.end(), each) == main->channels.end()) {
        result.push_back(named ? header.name() + "." + each : each);
      }
    }
  }
  return result;
}

}  // namespace azulejo
