// bn info: what a file says of itself.

#include <fmt/format.h>

#include <optional>
#include <span>
#include <utility>

#include "bn/error.h"
#include "bn/volume.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

/// What the channels mean and what is worth knowing, each in a paragraph.
std::string sentences(const Json& result) {
  std::string text;
  for (const char* list : {"content", "notes"}) {
    if (!result.contains(list)) continue;
    text += fmt::format("\n{}\n", list);
    for (const Json& sentence : result[list]) text += paragraph(sentence.get<std::string>(), 0);
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
    return output.write(lines_of(result) + below);
  }
  for (const char* name : {"recipe", "tiles", "pixel_hash"}) metadata.erase(name);
  result.update(metadata);
  if (!content.metadata->tiles.empty()) result["energy"] = energy_text(content.metadata->tiles);
  output.write(lines_of(result) + below + "\nrecipe\n" + content.metadata->recipe);
}

}  // namespace

namespace {

struct Settings {
  std::vector<std::filesystem::path> paths;
  bool json = false;
};

Json json_of(const std::filesystem::path& path, const Volume& content) {
  Json result{{"file", path.string()},
              {"size", to_json(content.image.size)},
              {"channels", content.image.channels},
              {"type", name_of(content.image.type)},
              {"pixel_hash", pixel_hash(content.image)}};
  if (!content.channel_names.empty()) result["channel_names"] = content.channel_names;
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
  return result;
}

/// Prints each as it is read. One that cannot be read does not silence the others.
class Printer {
 public:
  Printer(const Settings& settings, Session& session)
      : settings_(settings), session_(session), several_(settings.paths.size() > 1) {}

  void look_at(const std::filesystem::path& path) {
    std::error_code failed;
    if (!std::filesystem::is_directory(path, failed)) return attempt(path);
    // A folder is one volume, or else pictures that have nothing in common.
    const std::vector<std::filesystem::path> files = image_files(path);
    try {
      return print(path, read_volume(path, {}, session_.execution));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_input || files.empty()) throw;
      note_if_numbered(path);
    }
    several_ = several_ || files.size() > 1;
    for (const auto& file : files) attempt(file);
  }

  /// Names of slices that are no volume since one is missing or comes twice, which people should know.
  void note_if_numbered(const std::filesystem::path& folder) {
    try {
      slice_files(std::span(&folder, 1));
    } catch (const Error& error) {
      session_.progress.note(fmt::format("no volume: {}", error.what()));
    }
  }

  void attempt(const std::filesystem::path& path) {
    try {
      print(path, read_volume(path, {}, session_.execution));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled || !several_) throw;
      session_.progress.note(error.what());
      if (!first_failure_) first_failure_ = error;
      ++failures_;
    }
  }

  void finish() {
    if (settings_.json && several_) session_.output.write_result(all_, true);
    if (!first_failure_) return;
    ErrorInfo info = first_failure_->info();
    if (failures_ > 1) info.what += fmt::format("; {} files in all cannot be read", failures_);
    throw Error(info);
  }

 private:
  void print(const std::filesystem::path& path, const Volume& content) {
    Json result = json_of(path, content);
    if (settings_.json) {
      if (several_) return all_.push_back(std::move(result));
      return session_.output.write_result(result, true);
    }
    if (!std::exchange(is_first_, false)) session_.output.write("\n");
    print_text(std::move(result), content, session_.output);
  }

  const Settings& settings_;
  Session& session_;
  bool several_;
  bool is_first_ = true;
  Json all_ = Json::array();
  std::optional<Error> first_failure_;
  int failures_ = 0;
};

}  // namespace

Verb info_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "info";
  verb.summary = "Print what textures are and what they say of themselves.";
  verb.examples = {{"bn info atlas.png", "size, kind, step, radius, energies, bounds, hash and recipe"},
                   {"bn info out", "every texture right in a folder, or the one volume that it holds"},
                   {"bn info mask.png --json", "the same for a program"}};
  verb.details =
      "Reads images and volumes (PNG, EXR, TIFF, KTX2, DDS, .bin, .h and what else OpenImageIO reads; a "
      "folder of "
      "slices or slice_%03d.png) and prints size, channels and pixel hash, and, where bn wrote the file, "
      "what "
      "its channels mean and the metadata it carries. The recorded hash is compared with the pixels; bn "
      "verify "
      "checks the other claims.\n\n"
      "Several files are printed one after the other, in JSON as one list. One that cannot be read is named, "
      "and "
      "the others are printed all the same.";
  verb.arguments.positional_list("FILE|DIR", settings->paths, file_path(),
                                 "The images and volumes to look at.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) {
    Printer printer(*settings, session);
    for (const auto& path : settings->paths) printer.look_at(path);
    printer.finish();
  };
  return verb;
}

}  // namespace bn::tools
