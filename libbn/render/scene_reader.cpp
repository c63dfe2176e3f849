// Scene files: TOML. Every key that is not understood is an error, with the line it stands on; the
// numbers are judged by check_scene(). Keys: docs/validation.md.

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>

#include "bn/error.h"
#include "bn/texture.h"
#include "core/toml_document.h"
#include "render/scene.h"

namespace bn {
using namespace render;
namespace {

struct ShippedScene {
  std::string_view name;
  std::string_view toml;
};

constexpr ShippedScene kShipped[] = {
#include "render/shipped_scenes.inc"
};

class Reader {
 public:
  explicit Reader(std::string where) : where_(std::move(where)) {}

  Scene read(const toml::table& root) {
    only(root, {"name", "about", "sky", "fov_degrees", "pan_px", "camera", "material", "quad", "box",
                "sphere", "region"});
    Scene scene;
    scene.name = text(root, "name");
    if (root.contains("about")) scene.about = text(root, "about");
    if (root.contains("sky")) scene.sky = colour(root, "sky");
    scene.fov_degrees = number(root, "fov_degrees", 45.0);
    if (root.contains("pan_px")) {
      const auto pan = numbers(root, "pan_px", 2);
      scene.pan_x_px = pan[0];
      scene.pan_y_px = pan[1];
    }
    for (const toml::table* table : tables(root, "camera")) {
      only(*table, {"frame", "eye", "at"});
      scene.camera.push_back(
          {.frame = integer(*table, "frame", 0), .eye = vector(*table, "eye"), .at = vector(*table, "at")});
    }
    for (const toml::table* table : tables(root, "material")) read_material(scene, *table);
    for (const toml::table* table : tables(root, "quad")) {
      only(*table, {"corner", "edge_u", "edge_v", "material"});
      scene.rectangles.push_back({.corner = vector(*table, "corner"),
                                  .edge_u = vector(*table, "edge_u"),
                                  .edge_v = vector(*table, "edge_v"),
                                  .material = material(*table)});
    }
    for (const toml::table* table : tables(root, "box")) read_box(scene, *table);
    for (const toml::table* table : tables(root, "sphere")) {
      only(*table, {"centre", "radius", "material"});
      scene.spheres.push_back({.centre = vector(*table, "centre"),
                               .radius = number(*table, "radius", std::nan("")),
                               .material = material(*table)});
    }
    for (const toml::table* table : tables(root, "region")) {
      only(*table, {"name", "x", "y", "width", "height"});
      scene.regions.push_back({.name = text(*table, "name"),
                               .x = number(*table, "x", 0.0),
                               .y = number(*table, "y", 0.0),
                               .width = number(*table, "width", 1.0),
                               .height = number(*table, "height", 1.0)});
    }
    return scene;
  }

 private:
  [[noreturn]] void fail(const toml::node& node, std::string what, std::string limit = "") const {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::move(what),
                 .where = fmt::format("{}:{}", where_, node.source().begin.line),
                 .limit = std::move(limit),
                 .remedy = ""});
  }

  void only(const toml::table& table, std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, value] : table) {
      if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
      fail(value, fmt::format("unknown key '{}'", key.str()), fmt::format("{}", fmt::join(keys, ", ")));
    }
  }

  std::vector<const toml::table*> tables(const toml::table& table, std::string_view key) const {
    std::vector<const toml::table*> result;
    const toml::node* node = table.get(key);
    if (!node) return result;
    const toml::array* array = node->as_array();
    if (!array) fail(*node, fmt::format("'{}' is no list of tables", key), fmt::format("[[{}]]", key));
    for (const toml::node& entry : *array) {
      if (!entry.as_table())
        fail(entry, fmt::format("'{}' is no list of tables", key), fmt::format("[[{}]]", key));
      result.push_back(entry.as_table());
    }
    return result;
  }

  const toml::node& need(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (!node) fail(table, fmt::format("'{}' is missing", key));
    return *node;
  }

  std::string text(const toml::table& table, std::string_view key) const {
    const toml::node& node = need(table, key);
    const auto value = node.value<std::string>();
    if (!value || value->empty()) fail(node, fmt::format("'{}' is no text", key));
    return *value;
  }

  double finite(const toml::node& node, std::string_view key) const {
    const auto value = node.value<double>();
    if (!value || !std::isfinite(*value)) fail(node, fmt::format("'{}' is no finite number", key));
    return *value;
  }

  double number(const toml::table& table, std::string_view key, double otherwise) const {
    if (!table.contains(key) && !std::isnan(otherwise)) return otherwise;
    return finite(need(table, key), key);
  }

  int integer(const toml::table& table, std::string_view key, int otherwise) const {
    const toml::node* node = table.get(key);
    if (!node) return otherwise;
    const auto value = node->as_integer();
    if (!value || value->get() < 0 || value->get() > 1'000'000) {
      fail(*node, fmt::format("'{}' is no whole number", key), "0..1000000");
    }
    return static_cast<int>(value->get());
  }

  std::vector<double> numbers(const toml::table& table, std::string_view key, std::size_t count) const {
    const toml::node& node = need(table, key);
    const toml::array* array = node.as_array();
    if (!array || array->size() != count)
      fail(node, fmt::format("'{}' is no list of {} numbers", key, count));
    std::vector<double> result;
    for (const toml::node& entry : *array) result.push_back(finite(entry, key));
    return result;
  }

  Vector vector(const toml::table& table, std::string_view key) const {
    const auto v = numbers(table, key, 3);
    return {v[0], v[1], v[2]};
  }

  Rgb colour(const toml::table& table, std::string_view key) const {
    const auto v = numbers(table, key, 3);
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  }

  void read_material(Scene& scene, const toml::table& table) {
    only(table, {"name", "albedo", "emission", "roughness", "checker", "checker_albedo", "image"});
    Material made;
    if (table.contains("albedo")) made.albedo = colour(table, "albedo");
    if (table.contains("emission")) made.emission = colour(table, "emission");
    if (table.contains("roughness")) {
      made.roughness = static_cast<float>(number(table, "roughness", 0.0));
      if (made.roughness < 0.0f) fail(need(table, "roughness"), "roughness below 0", "0.05..1");
    }
    if (table.contains("checker")) {
      const auto cells = numbers(table, "checker", 2);
      for (const double cell : cells) {
        if (cell != std::floor(cell) || cell < 0 || cell > 1023)
          fail(need(table, "checker"), "checker cells", "0..1023");
      }
      made.checker_u = static_cast<int>(cells[0]);
      made.checker_v = static_cast<int>(cells[1]);
      made.checker_albedo = colour(table, "checker_albedo");
    }
    if (table.contains("image")) {
      made.image = static_cast<int>(scene.images.size());
      scene.images.push_back(read_albedo(need(table, "image"), text(table, "image")));
    }
    if (!materials_.emplace(text(table, "name"), static_cast<int>(scene.materials.size())).second) {
      fail(table, fmt::format("a second material '{}'", text(table, "name")));
    }
    scene.materials.push_back(made);
  }

  /// An image beside the scene's file, as reflectances: 8 and 16 bits as sRGB (IEC 61966-2-1), floats as they
  /// are.
  Grid<Rgb> read_albedo(const toml::node& node, const std::string& name) const {
    Image image;
    try {
      image = read_image(std::filesystem::path(where_).parent_path() / name).image;
    } catch (const Error& error) {
      throw Error({.code = error.code(),
                   .what = error.what(),
                   .where = fmt::format("{}:{}", where_, node.source().begin.line),
                   .limit = "",
                   .remedy = ""});
    }
    if (image.size.area() > kMaxTexels)
      fail(node, fmt::format("{} texels", image.size.area()), fmt::format("1..{}", kMaxTexels));
    if (image.type == SampleType::f16) image = to_float(image);
    const auto value = [&](std::size_t index) {
      const std::byte* sample = image.samples.data() + index * bytes_per_sample(image.type);
      if (image.type == SampleType::f32) {
        float linear;
        std::memcpy(&linear, sample, sizeof linear);
        return linear;
      }
      std::uint16_t wide = 0;
      std::memcpy(&wide, sample, bytes_per_sample(image.type));  // little-endian machines
      const double shown = wide / (image.type == SampleType::u8 ? 255.0 : 65535.0);
      return static_cast<float>(shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4));
    };
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    Grid<Rgb> albedo(image.size);
    for (std::size_t i = 0; i < albedo.count(); ++i) {
      const auto channel = [&](std::size_t c) { return value(i * channels + (channels < 3 ? 0 : c)); };
      albedo[i] = {channel(0), channel(1), channel(2)};
    }
    return albedo;
  }

  int material(const toml::table& table) const {
    const std::string name = text(table, "material");
    const auto found = materials_.find(name);
    if (found == materials_.end()) fail(need(table, "material"), fmt::format("no material '{}'", name));
    return found->second;
  }

  /// Six rectangles around `centre`, turned about the vertical.
  void read_box(Scene& scene, const toml::table& table) const {
    only(table, {"centre", "size", "turn_degrees", "material"});
    const Vector centre = vector(table, "centre");
    const Vector size = vector(table, "size");
    const double turn = number(table, "turn_degrees", 0.0) * std::numbers::pi / 180.0;
    const Vector axes[3] = {{std::cos(turn) * size.x, 0.0, -std::sin(turn) * size.x},
                            {0.0, size.y, 0.0},
                            {std::sin(turn) * size.z, 0.0, std::cos(turn) * size.z}};
    for (int axis = 0; axis < 3; ++axis) {
      const Vector &n = axes[axis], &u = axes[(axis + 1) % 3], &v = axes[(axis + 2) % 3];
      for (const double side : {-0.5, 0.5}) {
        const auto along = [&](double Vector::*c) {
          return centre.*c + side * n.*c - 0.5 * (u.*c) - 0.5 * (v.*c);
        };
        scene.rectangles.push_back({.corner = {along(&Vector::x), along(&Vector::y), along(&Vector::z)},
                                    .edge_u = u,
                                    .edge_v = v,
                                    .material = material(table)});
      }
    }
  }

  std::string where_;
  std::map<std::string, int> materials_;
};

}  // namespace

std::vector<std::string> shipped_scene_names() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : kShipped) names.emplace_back(scene.name);
  return names;
}

Scene read_scene(std::string_view text, const std::string& where) {
  Scene scene = Reader(where).read(document::parse_toml(text, where));
  try {
    check_scene(scene);
  } catch (const Error& error) {
    ErrorInfo info = error.info();
    info.where = fmt::format("{}, {}", where, info.where);
    throw Error(info);
  }
  return scene;
}

Scene load_scene(const std::string& name_or_path) {
  for (const ShippedScene& scene : kShipped) {
    if (scene.name == name_or_path) return read_scene(scene.toml, name_or_path);
  }
  std::ifstream file(name_or_path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  if (!file) {
    throw Error({.code = ErrorCode::io,
                 .what = "neither a shipped scene nor a file that can be read",
                 .where = name_or_path,
                 .limit = fmt::format("shipped: {}", fmt::join(shipped_scene_names(), ", ")),
                 .remedy = ""});
  }
  return read_scene(content.str(), name_or_path);
}

}  // namespace bn
