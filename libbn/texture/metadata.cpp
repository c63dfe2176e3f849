// Metadata as one JSON object, in a fixed order of members, pure ASCII and without line breaks: so it
// survives every container (PNG text is Latin-1, TIFF text ends at a zero byte) and equal metadata
// gives equal bytes. The schema is in docs/files.md. Reading is strict and keeps everything: members
// that only some kinds of texture have become facts, which verification compares with the recipe.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "bn/texture.h"
#include "texture/error.h"
#include "texture/metadata.h"

namespace bn {
namespace {

using nlohmann::ordered_json;

constexpr const char* kWhere = "metadata";

/// Takes the members of one object one by one; finish() refuses those that nobody took.
class Members {
 public:
  Members(ordered_json object, std::string where) : object_(std::move(object)), where_(std::move(where)) {
    if (!object_.is_object()) texture::fail_input(where_, "not a JSON object");
  }

  std::optional<ordered_json> take(const char* key) {
    const auto found = object_.find(key);
    if (found == object_.end()) return std::nullopt;
    ordered_json value = std::move(*found);
    object_.erase(found);
    return value;
  }

  std::optional<std::string> text(const char* key) {
    const auto value = take(key);
    if (!value) return std::nullopt;
    if (!value->is_string()) refuse(key, "a string");
    return value->get<std::string>();
  }

  template <class Integer>
  std::optional<Integer> integer(const char* key) {
    const auto value = take(key);
    if (!value) return std::nullopt;
    return to_integer<Integer>(*value, key);
  }

  std::optional<Offset> offset(const char* key) {
    const auto value = take(key);
    if (!value) return std::nullopt;
    if (!value->is_array() || value->size() != 2) refuse(key, "a pair of integers");
    return Offset{to_integer<int>((*value)[0], key), to_integer<int>((*value)[1], key)};
  }

  template <class T>
  T required(const char* key, std::optional<T> value) const {
    if (!value) texture::fail_input(where_, fmt::format("member '{}' is missing", key));
    return *std::move(value);
  }

  void finish() const {
    if (object_.empty()) return;
    texture::fail_input(where_, fmt::format("unknown member '{}'", object_.begin().key()));
  }

  /// All that nobody took, in its order.
  Facts facts() const {
    constexpr std::size_t kMostFacts = 64;
    if (object_.size() > kMostFacts) {
      texture::fail_input(where_, fmt::format("{} members that are not known", object_.size()),
                          fmt::format("at most {}", kMostFacts));
    }
    Facts facts;
    for (const auto& [key, value] : object_.items()) facts.add(checked_key(key), value_of(value, key));
    return facts;
  }

 private:
  std::string checked_key(const std::string& key) const {
    const bool sound = !key.empty() && key.size() <= 40 && std::all_of(key.begin(), key.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (!sound) texture::fail_input(where_, "a member with an unfit name", "1..40 of a..z, 0..9, '_'");
    return key;
  }

  Value value_of(const ordered_json& value, const std::string& key) const {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return value.get<double>();
    if (value.is_number()) return to_integer<std::int64_t>(value, key.c_str());
    constexpr std::size_t kLongest = 1024;
    if (!value.is_array() || value.size() > kLongest) refuse(key.c_str(), "a truth, number, text or list");
    std::vector<std::int64_t> list;
    for (const ordered_json& element : value) list.push_back(to_integer<std::int64_t>(element, key.c_str()));
    return list;
  }

  [[noreturn]] void refuse(const char* key, std::string_view wanted) const {
    texture::fail_input(where_, fmt::format("member '{}' is not {}", key, wanted));
  }

  template <class Integer>
  Integer to_integer(const ordered_json& value, const char* key) const {
    using Limits = std::numeric_limits<Integer>;
    if (value.is_number_unsigned()) {
      const auto number = value.get<std::uint64_t>();
      if (number <= static_cast<std::uint64_t>(Limits::max())) return static_cast<Integer>(number);
    } else if (value.is_number_integer()) {
      const auto number = value.get<std::int64_t>();  // negative, since not unsigned
      if (Limits::is_signed && number >= static_cast<std::int64_t>(Limits::min())) {
        return static_cast<Integer>(number);
      }
    }
    refuse(key, fmt::format("an integer in {}..{}", Limits::min(), Limits::max()));
  }

  ordered_json object_;
  std::string where_;
};

ordered_json pair_of(Offset offset) { return ordered_json::array({offset.x, offset.y}); }

Metadata metadata_from(ordered_json object) {
  Members members(std::move(object), kWhere);
  const auto version = members.required("bn_metadata", members.integer<int>("bn_metadata"));
  if (version != texture::kMetadataVersion) {
    texture::fail_input(kWhere, fmt::format("metadata version {}", version),
                        fmt::format("{}", texture::kMetadataVersion), "read it with a newer version of bn");
  }
  Metadata metadata;
  metadata.tool_version = members.required("tool_version", members.text("tool_version"));
  metadata.algorithm = members.required("algorithm", members.text("algorithm"));
  metadata.algorithm_version =
      members.required("algorithm_version", members.integer<int>("algorithm_version"));
  metadata.kind = members.required("kind", members.text("kind"));
  metadata.recipe = members.required("recipe", members.text("recipe"));
  if (auto tiles = members.take("tiles")) {
    if (!tiles->is_array()) texture::fail_input(kWhere, "member 'tiles' is not an array");
    for (std::size_t i = 0; i < tiles->size(); ++i) {
      Members tile(std::move((*tiles)[i]), fmt::format("metadata, tile {}", i));
      metadata.tiles.push_back(
          {.motion = tile.required("motion", tile.offset("motion")),
           .start_energy = tile.required("start_energy", tile.integer<std::int64_t>("start_energy")),
           .energy = tile.required("energy", tile.integer<std::int64_t>("energy")),
           .lower_bound = tile.required("lower_bound", tile.integer<std::int64_t>("lower_bound"))});
      tile.finish();
    }
  }
  metadata.pixel_hash = members.required("pixel_hash", members.text("pixel_hash"));
  metadata.facts = members.facts();
  return metadata;
}

/// nlohmann's parser builds nested values without recursion, but copying and destroying them recurse
/// in part; nothing of ours nests deeper than four.
bool nests_deeper_than(std::string_view json, int limit) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > limit) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

}  // namespace

std::string to_json(const Metadata& metadata, int indent) {
  ordered_json object;
  object["bn_metadata"] = texture::kMetadataVersion;
  object["tool_version"] = metadata.tool_version;
  object["algorithm"] = metadata.algorithm;
  object["algorithm_version"] = metadata.algorithm_version;
  object["kind"] = metadata.kind;
  object["recipe"] = metadata.recipe;
  for (const auto& [key, value] : metadata.facts) {
    std::visit(
        [&, &name = key](const auto& held) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) object[name] = held;
        },
        value);
  }
  for (const TileRecord& tile : metadata.tiles) {
    object["tiles"].push_back({{"motion", pair_of(tile.motion)},
                               {"start_energy", tile.start_energy},
                               {"energy", tile.energy},
                               {"lower_bound", tile.lower_bound}});
  }
  object["pixel_hash"] = metadata.pixel_hash;
  try {
    return object.dump(indent, ' ', /*ensure_ascii=*/true);
  } catch (const nlohmann::json::exception& error) {
    texture::fail_input(kWhere, fmt::format("text that is not UTF-8 ({})", error.what()));
  }
}

Metadata metadata_from_json(std::string_view json) {
  ordered_json object;
  if (!nests_deeper_than(json, 16)) {
    object = ordered_json::parse(json, nullptr, /*allow_exceptions=*/false);
  }
  if (!object.is_object()) texture::fail_input(kWhere, "not a JSON object");
  return metadata_from(std::move(object));
}

namespace texture {

void read_description(std::string_view description, FileContent& content) {
  if (description.find("\"bn_metadata\"") == std::string_view::npos) return;
  try {
    content.metadata = metadata_from_json(description);
  } catch (const Error& error) {
    content.metadata_fault = error.what();
  }
}

}  // namespace texture
}  // namespace bn
