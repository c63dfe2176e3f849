// Textures that the report tests look at.

#pragma once

#include "bn/noise.h"
#include "bn/report.h"
#include "bn/retarget.h"
#include "spectrum/reference_stbn.h"
#include "texture/fixtures.h"

namespace bn::report {

using texture::bytes_of;
using texture::put_bytes;
using texture::TemporaryFolder;

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

inline Metadata mask_metadata() {
  Metadata metadata;
  metadata.algorithm = "void-and-cluster";
  metadata.algorithm_version = 1;
  metadata.kind = "mask";
  metadata.facts.add("seed", 1);
  return metadata;
}

inline Image mask_image(int side, std::uint64_t seed) {
  return encode_mask(void_and_cluster({.size = {side, side}, .seed = seed}), SampleType::u8);
}

inline void write_mask(const std::filesystem::path& path, int side, std::uint64_t seed) {
  write_image(path, mask_image(side, seed), mask_metadata());
}

/// Of tiles by the exact solver, without their source.
inline Metadata retarget_metadata(const char* kind, const RetargetOptions& options) {
  Metadata metadata;
  metadata.algorithm = "retarget-exact";
  metadata.algorithm_version = 1;
  metadata.kind = kind;
  metadata.facts.add("step", options.step);
  metadata.facts.add("radius", options.radius);
  metadata.facts.add("reach", "chebyshev");
  metadata.facts.add("metric", "l1");
  metadata.facts.add("wrap", Value(true));
  metadata.facts.add("form", "scatter");
  return metadata;
}

/// set/mask.png, set/atlas.png (nine motions) and a manifest, as a bake leaves them.
inline void write_set(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "set");
  const Image mask = mask_image(32, 1);
  write_image(folder / "set/mask.png", mask, mask_metadata());
  const RetargetOptions options{.step = {24, 19}, .radius = 4};
  Metadata metadata = retarget_metadata("retarget-atlas", options);
  metadata.facts.add("source", "mask.png");
  metadata.facts.add("source_channel", 0);
  metadata.facts.add("source_hash", pixel_hash(mask));
  std::vector<Image> tiles;
  const auto set = solve_motion_set(levels_of_channel(mask, 0).value, options, 1);
  for (int i = 0; i < 9; ++i) {
    const RetargetTile& tile = set[static_cast<std::size_t>(i)];
    tiles.push_back(encode_moves(tile.move));
    metadata.tiles.push_back({{i % 3 - 1, i / 3 - 1}, tile.start_energy, tile.energy, tile.lower_bound});
  }
  write_image(folder / "set/atlas.png", make_atlas(tiles, 3), metadata);
  write_text_file(folder / "manifest.json",
                  R"({"jobs": [{"name": "m", "kind": "mask", "files": [{"path": "set/mask.png"}]},
                      {"name": "moves", "kind": "retarget", "files": [{"path": "set/atlas.png"}]}],
                      "times": {"jobs": {"m": 0.5, "moves": 1.25}}})");
}

/// A spatiotemporal mask of 32 x 32 x 16, a file a slice.
inline void write_volume(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto volume = test::spatiotemporal_mask({32, 32, 16}, 1.9, 1.9, 1);
  for (std::size_t z = 0; z < 16; ++z) {
    Image slice{.size = {32, 32}, .channels = 1, .type = SampleType::u8, .samples = {}};
    for (std::size_t i = 0; i < 1024; ++i) {
      slice.samples.push_back(static_cast<std::byte>(static_cast<int>(volume[z * 1024 + i]) / 64));
    }
    write_image(folder / ("slice" + std::to_string(z) + ".png"), slice, mask_metadata());
  }
}

inline void write_blank(const std::filesystem::path& path, Extent size) {
  Image picture{.size = size, .channels = 3, .type = SampleType::u8, .samples = {}};
  picture.samples.resize(static_cast<std::size_t>(size.area()) * 3);
  write_image(path, picture, {});
}

/// A validation study of one scene, "room", by four methods, as bn validate leaves it.
inline void write_study(const std::filesystem::path& folder) {
  const auto write = [&](const char* name, const char* text) { write_text_file(folder / name, text); };
  std::filesystem::create_directories(folder / "room");
  write("study.json",
        R"({"size":[4,2],"bounces":2,"frames":1,"first_counted":1,"block":8,"reference_paths":64,
              "device":"a <device>","scenes":[{"name":"room","about":"A room & a lamp.","moves":false,
              "reference_rmse":0.01}]})");
  write("summary.csv",
        "scene,variant,region,db_against_white\nroom,white,picture,0.00\nroom,sort,picture,-3.25\n"
        "room,retarget,picture,-9.00\nroom,reproject,picture,-9.00\n");
  write("errors.csv",
        "scene,variant,frame,region,rmse,rmse_blur_1.5,power_to_0.1,reference_power_to_0.1,flicker,"
        "rmse_exponential_average,rmse_exponential_average_blur_1.5\n"
        "room,white,0,picture,0.5,0.125,0.25,0.001,,0.4,0.02\nroom,white,1,picture,0.5,0.125,0.25,0.001,0.06,"
        "0.4,0.02\n"
        "room,sort,0,picture,0.5,0.1,0.25,0.001,,0.4,0.02\nroom,sort,1,picture,0.5,0.1,0.1,0.001,0.05,0.3,0."
        "015\n"
        "room,retarget,1,picture,0.5,0.0625,0.1,0.001,0.05,0.3,0.015\n"
        "room,reproject,1,picture,0.5,0.0625,0.1,0.001,0.05,0.3,0.015\n");
  write("radial.csv",
        "scene,variant,frame,region,frequency,power\nroom,sort,1,picture,0.1,0.1\nroom,sort,1,picture,0.2,"
        "0.3\n");
  write("passes.csv",
        "scene,variant,pass,milliseconds,percent_of_frame,bytes\nroom,reproject,trace,12.5,80,2048\n");
  // Four methods, three rows, pictures of 64 pixels.
  write_blank(folder / "room" / "methods.png", {4 * 132 + 4, 3 * 132 + 4});
  write_blank(folder / "room" / "white.png", {4, 2});
  write_blank(folder / "room" / "retarget.png", {4, 2});
}

}  // namespace bn::report
