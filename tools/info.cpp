// bn info: what a file says of itself.

#include <fmt/format.h>

#include "bn/volume.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

/// What the channels mean and what is worth knowing, a line each.
std::string sentences(const Json& result) {
  std::string text;
  for (const char* list : {"content", "notes"}) {
    if (!result.contains(list)) continue;
    text += fmt::format("\n{}\n", list);
    for (const Json& sentence : result[list]) text += sentence.get<std::string>() + "\n";
  }
  return text;
}

/// For people: without the nesting, the tiles in one line, sentences below and the recipe last and as it is.
void print_text(Json result, const Volume& content, Output& output) {
  Json metadata = std::move(result["metadata"]);
  result.erase("metadata");
  const std::string below = sentences(result);
  result.erase("content");
  result.erase("notes");
  if (!content.metadata) {
    result["made_by"] = "another program";
    output.write_result(result, false);
    return output.write(below);
  }
  for (const char* name : {"recipe", "tiles", "pixel_hash"}) metadata.erase(name);
  result.update(metadata);
  if (!content.metadata->tiles.empty()) result["energy"] = energy_text(content.metadata->tiles);
  output.write_result(result, false);
  output.write(below + "\nrecipe\n" + content.metadata->recipe);
}

}  // namespace

Verb info_verb() {
  struct Settings {
    std::filesystem::path file;
    bool json = false;
  };
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "info";
  verb.summary = "Print what a texture is and what it says of itself.";
  verb.examples = {{"bn info atlas.png", "size, kind, step, radius, energies, bounds, hash and recipe"},
                   {"bn info mask.png --json", "the same for a program"}};
  verb.details =
      "Reads an image or a volume (PNG, EXR, TIFF, KTX2, DDS, .bin, .h and what else OpenImageIO reads; a "
      "folder of "
      "slices or slice_%03d.png) and prints its size, channels and pixel hash, and, where bn wrote the file, "
      "what "
      "its channels mean and the metadata it carries. The recorded hash is compared with the pixels; bn "
      "verify "
      "checks the other claims.";
  verb.arguments.positional("FILE", settings->file, file_path(), "The image or volume to look at.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) {
    const Volume content = read_volume(settings->file, {}, session.execution);
    const std::string hash = pixel_hash(content.image);
    Json result{{"file", settings->file.string()},
                {"size", to_json(content.image.size)},
                {"channels", content.image.channels},
                {"type", name_of(content.image.type)},
                {"pixel_hash", hash}};
    if (content.image.depth > 1) result["depth"] = content.image.depth;
    if (content.files.size() > 1) result["files"] = content.files.size();
    if (!content.notes.empty()) result["notes"] = content.notes;
    if (content.metadata) {
      const auto meaning = content_description(content.image, *content.metadata);
      if (!meaning.empty()) result["content"] = meaning;
      result["pixels_as_recorded"] = content.as_recorded;
      result["metadata"] = Json::parse(bn::to_json(*content.metadata));
    } else {
      result["metadata"] = nullptr;
      if (!content.metadata_fault.empty()) result["metadata_fault"] = content.metadata_fault;
    }
    if (settings->json) return session.output.write_result(result, true);
    print_text(std::move(result), content, session.output);
  };
  return verb;
}

}  // namespace bn::tools
