#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "azulejo/conversion.h"
#include "azulejo/core/error.h"
#include "azulejo/pipeline.h"
#include "azulejo/pipeline_parts.h"

namespace azulejo {
namespace {

/// "labels.png:7" taken apart; no label if the text ends otherwise, or is a file as it stands.
std::pair<std::string, std::optional<int>> mask_and_label(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  std::error_code ignored;
  if (colon == std::string::npos || colon + 1 == text.size() || std::filesystem::exists(text, ignored))
    return {text, {}};
  int label = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data() + colon + 1, end, label);
  if (failure != std::errc() || stop != end || label < 0) return {text, {}};
  return {text.substr(0, colon), label};
}

}  // namespace

/// Takes `within` and `feather` of a step; false for another name, or an operation that can't be kept within an area.
bool Pipeline::select(Step& step, const std::string& name, const std::string& text) {
  if ((name != "within" && name != "feather") || !may_be_within(*step.operation)) return false;
  if (!step.selection) step.selection.emplace();
  Selection& selection = *step.selection;
  const Operation& within = *find_operation("within");
  try {
    if (name == "feather") {
      within.find_field("feather")->parse(&selection.options, text);
    } else if (text.find_first_not_of("0123456789+-.,eE") == std::string::npos) {
      if (std::ranges::count(text, ',') != 3) {
        throw Error(Error::Argument,
                    fmt::format("within: \"{}\", expected x,y,width,height, a mask, or LABELS:N", text));
      }
      within.find_field("rect")->parse(&selection.options, text);
    } else {
      const auto [mask, label] = mask_and_label(text);
      selection.mask = argument_input(mask);
      selection.options.label = label;
      if (!converts(kind(selection.mask), ValueKind::Image)) {
        throw Error(Error::Argument, fmt::format("within: {}", mismatch(selection.mask, ValueKind::Image)));
      }
    }
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", step.operation->name, error.what()));
  }
  return true;
}

/// The result of a step that is not on tiles, taken over inside the area.
Value Pipeline::kept_within(const Step& step, const Value& source) {
  const Selection& selection = *step.selection;
  const Image& before = *source.image();
  const Image& after = *step.values[0].image();
  check_kept(step, before.info(), after.info());
  const Value mask = selection.mask.step >= 0 ? convert(value(selection.mask), ValueKind::Image, run_) : Value();
  static const Image none;
  try {
    return Value(within(before, after, mask.empty() ? none : *mask.image(), selection.options, run_));
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled) throw;
    throw Error(error.kind(), fmt::format("{}: {}", step.operation->name, error.what()));
  }
}

void Pipeline::check_kept(const Step& step, const ImageInfo& before, const ImageInfo& after) {
  if (before == after) return;
  throw Error(Error::Argument, fmt::format("{}: within: it makes {} of {}, expected an image of the same kind",
                                           step.operation->name, describe(after), describe(before)));
}

/// Puts a step behind another that takes its first result over inside the area.
void Pipeline::keep_within(Step& step, ValueRef source) {
  const Operation& within = *find_operation("within");
  const Selection& selection = *step.selection;
  std::vector<ValueRef> sources{source, step.refs[0]};
  if (selection.mask.step >= 0) sources.push_back(ref(selection.mask));
  std::vector<ImageInfo> infos;
  for (const ValueRef each : sources) infos.push_back(graph_.info(each));
  check_kept(step, infos[0], infos[1]);
  try {
    step.refs[0] = graph_.add_node(make_node(within, &selection.options, infos), std::move(sources),
                                   step.label + "-within", {"result"});
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", step.operation->name, error.what()));
  }
}

}  // namespace azulejo
