#include "report/stacks.h"

#include <set>
#include <tuple>

namespace bn::report {

int slices_of(const FileContent& content) {
  if (!content.metadata) return 1;
  const Metadata& metadata = *content.metadata;
  if (const auto slices = metadata.facts.get<int>("slices")) return std::max(1, *slices);
  std::set<std::tuple<int, int>> motions;
  for (const TileRecord& tile : metadata.tiles) motions.emplace(tile.motion.x, tile.motion.y);
  return motions.empty() ? 1 : static_cast<int>(metadata.tiles.size() / motions.size());
}

std::optional<Stacks::Stack> Stacks::add(const Candidate& candidate, FileContent content) {
  Metadata common = *content.metadata;
  common.pixel_hash.clear();
  const std::string key =
      candidate.path.parent_path().string() + candidate.path.extension().string() + "\n" + to_json(common);
  Part& part = parts_[key];
  part.wanted = slices_of(content);
  part.slices.emplace_back(candidate, std::move(content));
  if (std::ssize(part.slices) < part.wanted) return {};
  Stack stack{.first = part.slices.front().first, .content = part.slices.front().second, .names = {}};
  std::vector<Image> images;
  for (auto& [one, slice] : part.slices) {
    stack.names.push_back(one.name);
    images.push_back(std::move(slice.image));
  }
  stack.content.image = stack_slices(images);
  stack.content.metadata->pixel_hash = pixel_hash(stack.content.image);
  parts_.erase(key);
  return stack;
}

std::vector<Stacks::Part> Stacks::incomplete() {
  std::vector<Part> parts;
  for (auto& [key, part] : parts_) parts.push_back(std::move(part));
  parts_.clear();
  return parts;
}

}  // namespace bn::report
