// What kinds of texture inherit: looking at options, reading inputs, and verification by making it again.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "bn/kind.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Value* value) {
  if (!value) return "none";
  Option plain;
  return text_from_value(plain, *value);
}

/// The facts of a file must be those of its recipe: none missing, none other, none beside.
std::string compare_metadata(const Metadata& recorded, const Metadata& expected) {
  if (recorded.algorithm != expected.algorithm || recorded.kind != expected.kind) {
    fail_check(fmt::format("the recipe makes a {} by {}, the record says a {} by {}", expected.kind,
                           expected.algorithm, recorded.kind, recorded.algorithm));
  }
  if (recorded.algorithm_version != expected.algorithm_version) {
    fail_check(fmt::format("made by version {} of {}; this tool has version {} and cannot make it again",
                           recorded.algorithm_version, recorded.algorithm, expected.algorithm_version));
  }
  for (const auto& [key, value] : expected.facts) {
    const Value* found = recorded.facts.find(key);
    if (found && *found == value) continue;
    fail_check(fmt::format("{} is {} in the recipe, {} in the record", key, text_of(&value), text_of(found)));
  }
  for (const auto& [key, value] : recorded.facts) {
    if (!expected.facts.find(key))
      fail_check(fmt::format("{} is {} in the record, none in the recipe", key, text_of(&value)));
  }
  return "agrees with the record";
}

std::string compare_pictures(const Image& stored, const Image& again) {
  if (again.size != stored.size) {
    fail_check(fmt::format("the recipe makes {}x{} pixels, the file has {}x{}", again.size.width,
                           again.size.height, stored.size.width, stored.size.height));
  }
  if (again.channels != stored.channels)
    fail_check(fmt::format("{} channels instead of {}", stored.channels, again.channels));
  if (again.type != stored.type) {
    fail_check(fmt::format("sample type is {} in the recipe, {} in the record", name_of(again.type),
                           name_of(stored.type)));
  }
  const auto [at, other] = std::mismatch(again.samples.begin(), again.samples.end(), stored.samples.begin());
  if (at == again.samples.end()) return "equal to the picture made again from its recipe";
  const auto bytes = static_cast<std::int64_t>(bytes_per_sample(again.type)) * again.channels;
  const auto pixel = static_cast<std::int64_t>(at - again.samples.begin()) / bytes;
  const std::int64_t width = again.size.width, area = again.size.area();
  fail_check(fmt::format("differs from the picture that its recipe makes, first at pixel ({}, {}){}",
                         pixel % area % width, pixel % area / width,
                         pixel >= area ? fmt::format(" of slice {}", pixel / area) : ""));
}

}  // namespace

void fail_check(std::string what) {
  throw Error({.code = ErrorCode::verification_failed,
               .what = std::move(what),
               .where = "",
               .limit = "",
               .remedy = ""});
}

Options options_of(const Entry& entry) { return const_cast<Entry&>(entry).options(); }

Options output_options_of(const Entry& entry, std::size_t output) {
  return const_cast<Entry&>(entry).output_options(output);
}

std::shared_ptr<Entry> Entry::with_output(std::size_t output) const {
  std::shared_ptr<Entry> single = clone();
  single->keep_output(output);
  return single;
}

void Entry::take_later_seeds(int number) {
  Options list = options();
  Option* const seed = list.find("seed");
  if (seed) seed->set(std::get<std::int64_t>(seed->get()) + number);
}

std::size_t Entry::input_output(const Entry&) const { return 0; }

void Entry::verify(const Image& image, const Metadata& metadata, const fs::path& folder, Checks& checks,
                   const Execution& execution) const {
  std::vector<Input> inputs;  // kinds that read inputs verify in their own way
  const bool agrees =
      checks.attempt("recipe", [&] { return compare_metadata(metadata, this->metadata(0, inputs, folder)); });
  if (!agrees) return;
  checks.attempt("pixels", [&] { return compare_pictures(image, make(inputs, execution).picture(0).image); });
}

}  // namespace bn
