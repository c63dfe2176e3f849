// bn info: what a file says of itself.

#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

/// For people: without the nesting, the tiles in one line, the recipe last and as it is.
void print_text(Json result, const FileContent& content, Output& output) {
  Json metadata = std::move(result["metadata"]);
  result.erase("metadata");
  if (!content.metadata) {
    result["made_by"] = "another program";
    return output.write_result(result, false);
  }
  for (const char* name : {"recipe", "tiles", "pixel_hash"}) metadata.erase(name);
  result.update(metadata);
  if (!content.metadata->tiles.empty()) result["energy"] = energy_text(content.metadata->tiles);
  output.write_result(result, false);
  output.write("\nrecipe\n" + content.metadata->recipe);
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
      "Reads an image (PNG, EXR, TIFF, .bin and what else OpenImageIO reads) and prints its size, channels "
      "and pixel "
      "hash, and, where bn wrote the file, the metadata it carries. The recorded hash is compared with the "
      "pixels; "
      "bn verify checks the other claims.";
  verb.arguments.positional("FILE", settings->file, file_path(), "The image to look at.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) {
    const FileContent content = read_image(settings->file, session.execution);
    const std::string hash = pixel_hash(content.image);
    Json result{{"file", settings->file.string()},
                {"size", to_json(content.image.size)},
                {"channels", content.image.channels},
                {"type", name_of(content.image.type)},
                {"pixel_hash", hash}};
    if (content.metadata) {
      result["pixels_as_recorded"] = content.metadata->pixel_hash == hash;
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
