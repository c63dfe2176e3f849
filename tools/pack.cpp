// bn pack: channels of several files as one texture.

#include <fmt/format.h>

#include <map>
#include <memory>

#include "bn/error.h"
#include "bn/volume.h"
#include "tools/channel.h"
#include "tools/keep_inputs.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

/// One argument: a file and, behind a colon, one of its channels.
struct ChannelSource {
  std::filesystem::path path;
  std::string channel;  ///< a number or a name; empty: all of them
};

struct Settings {
  std::vector<ChannelSource> sources;
  std::filesystem::path out;
  SliceKind slices = SliceKind::layers;
  bool json = false;
};

ValueKind<ChannelSource> channel_source() {
  return {.placeholder = "FILE[:CHANNEL]",
          .allowed = "a channel's number from 0, or its name in an EXR",
          .parse =
              [](std::string_view text, std::string_view where) {
                const std::filesystem::path whole = file_path().parse(text, where);
                const std::size_t colon = text.rfind(':');
                std::error_code error;
                const bool has_channel =
                    colon != std::string_view::npos && colon > 0 && colon + 1 < text.size();
                if (!has_channel || std::filesystem::exists(whole, error)) return ChannelSource{whole, ""};
                // A name that is no file's, "a:b/c.png" for one, keeps its colon.
                const std::filesystem::path file(text.substr(0, colon));
                const std::string channel(text.substr(colon + 1));
                const bool is_number = channel.find_first_not_of("0123456789") == std::string::npos;
                if (!is_number && !std::filesystem::exists(file, error) && !has_number(file))
                  return ChannelSource{whole, ""};
                return ChannelSource{file, channel};
              },
          .show = {},
          .completion = Completion::file};
}

std::string layout_text(const Image& image) {
  return fmt::format("{}x{}{} pixels, {}", image.size.width, image.size.height,
                     image.depth > 1 ? fmt::format("x{}", image.depth) : "", name_of(image.type));
}

/// The channels that the arguments name, all of one size and type. `files` keeps the images.
struct Channels {
  std::vector<ChannelRef> refs;
  Json list = Json::array();
};

Channels channels_of(const Settings& settings, const std::map<std::filesystem::path, Volume>& files) {
  Channels channels;
  const std::filesystem::path& first_path = settings.sources.front().path;
  const Image& first = files.at(first_path).image;
  for (const ChannelSource& source : settings.sources) {
    const Image& image = files.at(source.path).image;
    const auto refuse = [&](std::string what, std::string limit, std::string remedy) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = std::move(what),
                   .where = source.path.string(),
                   .limit = std::move(limit),
                   .remedy = std::move(remedy)});
    };
    if (image.shape() != first.shape() || image.type != first.type) {
      refuse(layout_text(image), fmt::format("{}, as {}", layout_text(first), first_path.string()),
             "pack files of one size and type");
    }
    const bool all = source.channel.empty();
    const int begin = all ? 0
                          : find_channel(source.channel, image.channels, files.at(source.path).channel_names,
                                         source.path.string());
    const int end = all ? image.channels : begin + 1;
    for (int c = begin; c < end; ++c) {
      channels.refs.push_back({&image, c});
      channels.list.push_back({{"file", source.path.string()}, {"channel", c}});
    }
  }
  return channels;
}

/// The command, as a comment of TOML: there is no recipe that makes such a file.
std::string recipe_of(const Settings& settings, const Json& list) {
  std::string text = "# bn pack";
  for (const Json& item : list) {
    text += fmt::format(" {}:{}", item["file"].get<std::string>(), item["channel"].get<int>());
  }
  text += " -o " + settings.out.filename().string();
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
  }
  return text + "\n";
}

void run(const Settings& settings, Session& session) {
  std::map<std::filesystem::path, Volume> files;
  for (const ChannelSource& source : settings.sources) {
    if (!files.contains(source.path)) {
      files.emplace(source.path, read_volume(source.path, {}, session.execution));
    }
  }
  const Channels channels = channels_of(settings, files);
  const Image& first = *channels.refs.front().image;
  const VolumeOutput output{.slices = settings.slices, .atlas = {}};
  for (const ChannelSource& source : settings.sources)
    check_keeps(settings.out, "--out", std::span(&source.path, 1));
  // Before the samples are copied: what the format cannot hold.
  check_volume_writable(settings.out, first.shape(), first.type, static_cast<int>(channels.refs.size()),
                        output);
  check_memory(session.execution,
               channels.refs.size() * (first.samples.size() / static_cast<std::size_t>(first.channels)),
               settings.out.string());
  const Image packed = pack_channels(channels.refs);
  Metadata metadata;
  metadata.algorithm = "pack";
  metadata.algorithm_version = 1;
  metadata.kind = "packed";
  metadata.recipe = recipe_of(settings, channels.list);
  const auto written = write_volume(settings.out, packed, metadata, output);
  Json result{{"file", settings.out.string()},
              {"size", to_json(packed.size)},
              {"channels", packed.channels},
              {"type", name_of(packed.type)},
              {"pixel_hash", pixel_hash(packed)}};
  if (packed.depth > 1) result["depth"] = packed.depth;
  if (written.size() > 1) result["files"] = written.size();
  result["sources"] = channels.list;
  session.output.write_result(result, settings.json);
}

}  // namespace

Verb pack_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "pack";
  verb.summary = "Put channels of several files into one texture.";
  verb.examples = {
      {"bn pack a.png b.png c.png d.png -o rgba.png", "four masks as red, green, blue and alpha"},
      {"bn pack noise.exr:3 passes.exr:Z -o two.exr", "chosen channels, by number from 0 or by name"},
      {"bn pack stack_a stack_b -o both.ktx2", "two folders of slices as a volume of two channels"}};
  verb.details =
      "A FILE gives all its channels, FILE:N gives channel N alone, in an EXR also by its name. It may also "
      "be a folder of slices or a "
      "pattern of numbered ones (slice_%03d.png). Samples are copied as they are: nothing is converted, "
      "scaled "
      "or multiplied by alpha, so the fourth channel leaves the other three alone. All files must have one "
      "size "
      "and sample type.\n\n"
      "The extension of the output names the format: .png and .ktx2 hold up to 4 channels, .dds 1, 2 or 4 "
      "(of "
      "floats also 3), .exr, .tif, .bin and .h up to 64. Volumes go to .ktx2, .dds, .exr, .bin, .h, or to a "
      "pattern.";
  verb.arguments.positional_list("FILE", settings->sources, channel_source(),
                                 "What to pack, in the order of the channels; FILE:N takes one channel.");
  verb.arguments.required_option("--out", settings->out, texture_path(), "The file to write.", "-o");
  verb.arguments.option(
      "--slices", settings->slices,
      choice_of<SliceKind>({{"layers", SliceKind::layers}, {"depth", SliceKind::depth}}),
      "What the slices of a volume become in .ktx2 and .dds: layers of a 2D array, or the depth of "
      "a 3D texture.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
