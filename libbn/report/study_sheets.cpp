// The study's pictures on its page. Sheets are cut, so that each picture stands under the name of its method
// and the page's own paper shows between them, light or dark.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "bn/texture.h"
#include "report/html.h"
#include "report/sheet.h"
#include "report/study_parts.h"

namespace bn::report {
namespace {

namespace fs = std::filesystem;

constexpr Extent kMostShown{1024, 768};  ///< pixels of a whole frame that the page holds
constexpr int kShownWide = 520;          ///< page pixels, about: two frames in a row

/// The picture, or its middle if it is larger than what a page should hold.
Image middle_of(const Image& image) {
  const Extent part{std::min(image.size.width, kMostShown.width),
                    std::min(image.size.height, kMostShown.height)};
  Image result{.size = part, .channels = image.channels, .type = image.type, .samples = {}};
  const std::size_t bytes = static_cast<std::size_t>(image.channels) * bytes_per_sample(image.type);
  const int left = (image.size.width - part.width) / 2, top = (image.size.height - part.height) / 2;
  for (int y = 0; y < part.height; ++y) {
    const auto begin = image.samples.begin() + static_cast<std::ptrdiff_t>(bytes) *
                                                   ((top + y) * std::int64_t{image.size.width} + left);
    result.samples.insert(result.samples.end(), begin,
                          begin + static_cast<std::ptrdiff_t>(bytes) * part.width);
  }
  return result;
}

/// A sheet that is cut: pictures by column and row.
class Cut {
 public:
  Cut(const fs::path& path, int columns, int rows, std::vector<std::string>& notes)
      : division_{columns, rows} {
    if (!fs::exists(path)) return;
    try {
      sheet_ = read_image(path).image;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled) throw;
      notes.push_back(error.what());
      return;
    }
    usable_ = sheet_picture(sheet_, division_, {0, 0}).has_value();
    if (!usable_)
      notes.push_back(fmt::format("{}: not a sheet of {} columns and {} rows", path.string(), columns, rows));
  }

  bool usable() const { return usable_; }
  std::string picture(int column, int row, std::string_view alt) const {
    const Image image = *sheet_picture(sheet_, division_, {column, row});
    return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", alt, base64(encode_png(image)));
  }

 private:
  Extent division_;
  Image sheet_;
  bool usable_ = false;
};

/// One column: a heading over pictures.
std::string column_of(const Cut& cut, int column, int first_row, int last_row, std::string_view heading,
                      std::string_view method) {
  static constexpr std::string_view kRows[] = {"picture", "error", "spectrum of the error"};
  std::string images;
  for (int row = first_row; row <= last_row; ++row) {
    const auto kind = static_cast<std::size_t>(3 - (last_row - row) - 1);
    images +=
        cut.picture(column, row, fmt::format("{}, {}: {}", escaped(method), escaped(heading), kRows[kind]));
  }
  return fmt::format("<figure class=\"column\"><figcaption>{}</figcaption>{}</figure>\n", escaped(heading),
                     images);
}

std::string frame_figure(const fs::path& path, std::string_view title, std::string_view words) {
  const Image whole = read_image(path).image, shown = middle_of(whole);
  const int scale = scale_for(shown.size.width, kShownWide);
  const std::string part = shown.size == whole.size
                               ? fmt::format("All {} × {} pixels", whole.size.width, whole.size.height)
                               : fmt::format("The middle {} × {} of {} × {} pixels", shown.size.width,
                                             shown.size.height, whole.size.width, whole.size.height);
  return fmt::format(
      "<figure class=\"frame\" style=\"--w:{}px\"><img alt=\"the whole frame\" "
      "src=\"data:image/png;base64,{}\">"
      "<figcaption><b>{}</b> {} {} at the last frame.</figcaption></figure>\n",
      shown.size.width * scale, base64(encode_png(shown)), title, words, part);
}

}  // namespace

std::string frames_html(const std::string& scene, const std::string& shown, const fs::path& folder) {
  const auto path = [&](const std::string& method) { return folder / scene / (method + ".png"); };
  std::string html;
  if (fs::exists(path("white")))
    html += frame_figure(path("white"), "Without:", "white noise, one path a pixel.");
  if (fs::exists(path(shown)))
    html +=
        frame_figure(path(shown), fmt::format("With {}:", escaped(shown)), "as many paths, better spread.");
  if (html.empty()) return {};
  return fmt::format(
      "<div class=\"frames\">{}</div>\n<p class=\"about\">Every method's last frame is in the folder {}, "
      "by its name.</p>\n",
      html, escaped(scene));
}

std::string sheets_html(const Study& study, const std::string& scene, const std::string& region,
                        const fs::path& folder, std::vector<std::string>& notes) {
  std::vector<std::string> all = distinct(study.errors, "variant", scene), methods, temporal, blocks;
  for (const std::string& name : all) {
    if (name.find("-block-") == std::string::npos) methods.push_back(name);
    if (name == "sort" || name == "retarget" || name == "reproject") temporal.push_back(name);
  }
  std::vector<int> sides;
  for (const std::string& name : all) {
    constexpr std::string_view kPrefix = "retarget-block-";
    if (name == "retarget") sides.push_back(study.block);
    if (name.starts_with(kPrefix)) sides.push_back(std::atoi(name.c_str() + kPrefix.size()));
  }
  std::sort(sides.begin(), sides.end());
  const std::string where = region == "picture" ? "the picture" : fmt::format("“{}”", escaped(region));
  const auto section = [&](std::string_view title, const std::string& columns, std::string_view look) {
    return fmt::format("<h4>{}</h4>\n<div class=\"wide\"><div class=\"sheet{}\">{}</div></div>\n", title,
                       look, columns);
  };
  std::string html;

  const Cut last(folder / scene / "methods.png", static_cast<int>(methods.size()), 3, notes);
  if (last.usable()) {
    std::string columns;
    for (std::size_t i = 0; i < methods.size(); ++i)
      columns += column_of(last, static_cast<int>(i), 0, 2, methods[i], "last frame");
    // Eight fit into a row of the page; more stand five in a row.
    html +=
        section(fmt::format("Frame {}", study.frames), columns, methods.size() > 8 ? " five-in-a-row" : "");
  }
  if (sides.size() > 1) {
    const Cut cut(folder / scene / "blocks.png", static_cast<int>(sides.size()), 3, notes);
    std::string columns;
    for (std::size_t i = 0; cut.usable() && i < sides.size(); ++i)
      columns += column_of(cut, static_cast<int>(i), 0, 2, fmt::format("{0} × {0}", sides[i]), "retarget");
    if (cut.usable())
      html += section(fmt::format("Frame {}, retarget by sort blocks", study.frames), columns, "");
  }
  if (!temporal.empty()) {
    const int frames = std::min(7, study.frames + 1);
    const Cut cut(folder / scene / "first-frames.png", frames, 2 * static_cast<int>(temporal.size()), notes);
    for (std::size_t i = 0; cut.usable() && i < temporal.size(); ++i) {
      std::string columns;
      const int row = 2 * static_cast<int>(i);
      for (int frame = 0; frame < frames; ++frame)
        columns += column_of(cut, frame, row, row + 1, fmt::format("frame {}", frame), temporal[i]);
      html += section(fmt::format("The first frames with {}: error and spectrum", escaped(temporal[i])),
                      columns, " in-a-row");
    }
  }
  if (html.empty()) return {};
  return fmt::format(
             "<h3>Errors and their spectra</h3>\n<p class=\"about\">A square in the middle of {}: the "
             "picture, its "
             "error (mid grey where there is none), and the error's spectrum (dark where there is none, zero "
             "frequency in the middle). The darker the middle, the less of the error is seen.</p>\n",
             where) +
         html;
}

}  // namespace bn::report
