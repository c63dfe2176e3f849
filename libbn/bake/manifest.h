// manifest.json: what a bake made. Deterministic but for "times"; schema in docs/recipes.md.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bn/bake.h"

namespace bn::baking {

inline constexpr const char* kManifestName = "manifest.json";
inline constexpr int kManifestVersion = 1;

struct Manifest {
  std::string recipe;  ///< whole, as the user wrote it
  bool complete = false;
  std::vector<JobRecord> jobs;
};

std::string manifest_text(const Manifest& manifest);

/// Errors: io (absent), invalid_input (no manifest of this version, cut short, edited beyond use).
Manifest read_manifest(const std::filesystem::path& path);

}  // namespace bn::baking
