#include "ui/texture_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ui/app.h"
#include "ui/flow.h"
#include "ui/keys.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr std::array<const char*, 2> kCuts{"XY", "XZ"};
constexpr float kNarrowEm = 72.0f;  ///< below this width, the columns on the right become one

constexpr std::array<const char*, 4> kChannels{"R", "G", "B", "A"};

int shown_channels(const TextureFile& texture) { return std::min(texture.images[0].channels, 4); }

/// "x, y" within `size`. None: it is no such pixel.
std::optional<Offset> pixel_of(std::string text, Extent size) {
  std::erase(text, ' ');
  const std::size_t comma = text.find(',');
  Offset at{-1, -1};
  const bool two = comma != std::string::npos && read_number(text.substr(0, comma), at.x) &&
                   read_number(text.substr(comma + 1), at.y);
  const bool within = at.x >= 0 && at.y >= 0 && at.x < size.width && at.y < size.height;
  return two && within ? std::optional(at) : std::nullopt;
}

}  // namespace

void TextureView::open(const std::filesystem::path& path) {
  path_ = path;
  opened_.clear();
  fresh_ = true;
}

void TextureView::parameters(Parameters& p) {
  p("texture.path", path_);
  int channels = static_cast<int>(section_.channels);
  p("texture.channels", channels, 1, static_cast<int>(kAllChannels));
  section_.channels = static_cast<unsigned>(channels);
  p("texture.moves", section_.moves);
  p("texture.xz", section_.xz);
  p("texture.slice", slice_, 0, 65535);
  p("texture.row", row_, 0, 65535);
  p("texture.columns", section_.cut.columns, 1, 65536);
  p("texture.rows", section_.cut.rows, 1, 65536);
  p("texture.whole_stack", whole_stack_);
  p("texture.thresholds", thresholds_, 0, 4);
  p("texture.fps", frames_per_second_, 1, 60);
  link_.parameters(p, "texture");
}

void TextureView::take(std::shared_ptr<const TextureFile> texture) {
  // Settings of a session or of an undone step are kept where they fit.
  texture_ = std::move(texture);
  if (std::exchange(fresh_, false)) {
    section_ = {.cut = guess_cut(*texture_), .moves = true};
    row_ = 0;
    // Of an atlas the plain tile, of motion (0, 0), is in the middle.
    slice_ = motion_range(*texture_) > 0 ? slice_count(*texture_, section_.cut) / 2 : 0;
  }
  if (!fits(*texture_, section_.cut)) section_.cut = guess_cut(*texture_);
  stale_ = true;
  cutting_.stop();
  playing_ = false;
  analysed_ = {};
  analysis_.reset();
  verdict_.reset();
  link_.pinned.reset();
  go_to_.clear();
  go_to_refused_ = false;
  spectrum_.clear();
  verifying_.stop();
  if (texture_->metadata) {
    verifying_.start([path = path_](const Execution& execution) { return verify_path(path, execution); }, 1);
  }
}

void TextureView::take_spectrum() {
  const bool in_time = section_.xz && analysis_->in_time_picture;
  spectrum_.set(in_time ? analysis_->in_time_picture : analysis_->plane_picture);
}

/// The picture of the section that is wanted now, or, while that is being cut out, of the last one.
void TextureView::update_picture() {
  if (auto picture = cutting_.poll()) picture_.set(std::move(*picture));
  if ((!stale_ && section_ == shown_) || cutting_.running()) return;
  if (shown_.xz != section_.xz && analysis_) take_spectrum();
  const int slices_read = section_.xz ? slice_count(*texture_, section_.cut) : 1;
  if (slice_size(*texture_, section_.cut).area() * slices_read <= kAtOnce) {
    picture_.set(picture_of(*texture_, section_));
  } else {
    // Not what was there: another texture's picture would stand beside this one's figures.
    if (stale_) picture_.clear();
    cutting_.start([texture = texture_, section = section_](const Execution&) {
      return std::make_shared<const Picture>(picture_of(*texture, section));
    });
  }
  shown_ = section_;
  stale_ = false;
}

void TextureView::update(App& app) {
  if (opened_ != path_ && !path_.empty()) {
    opened_ = path_;
    loading_.start([path = path_](const Execution& execution) {
      return std::make_shared<const TextureFile>(read_texture(path, execution));
    });
  }
  try {
    if (auto texture = loading_.poll()) {
      take(std::move(*texture));
      app.say(fmt::format("Opened {}", path_.filename().string()));
    }
  } catch (...) {
    app.report_in_flight();
    path_ = texture_ ? texture_->path : std::filesystem::path();
    opened_ = path_;
    fresh_ = false;
  }
  try {
    if (auto verdict = verifying_.poll()) verdict_ = std::move(*verdict);
  } catch (...) {
    app.report_in_flight();
  }
  try {
    if (auto analysis = analysing_.poll()) {
      analysis_ = std::move(*analysis);
      take_spectrum();
    }
  } catch (...) {
    app.report_in_flight();
  }
  if (!texture_) return;

  const int slices = slice_count(*texture_, section_.cut);
  if (slices < 2) section_.xz = false;
  if (playing_) {
    since_slice_s_ += static_cast<double>(ImGui::GetIO().DeltaTime);
    const auto steps = static_cast<int>(since_slice_s_ * frames_per_second_);
    since_slice_s_ -= static_cast<double>(steps) / frames_per_second_;
    int& position = section_.xz ? row_ : slice_;
    position = (position + steps) % (section_.xz ? slice_size(*texture_, section_.cut).height : slices);
  }
  slice_ = std::clamp(slice_, 0, slices - 1);
  row_ = std::clamp(row_, 0, slice_size(*texture_, section_.cut).height - 1);
  const unsigned there = (1u << shown_channels(*texture_)) - 1;
  section_.channels &= there;
  if (section_.channels == 0) section_.channels = there;
  section_.index = section_.xz ? row_ : slice_;
  try {
    update_picture();
  } catch (...) {
    app.report_in_flight();
  }
  update_analysis();
}

void TextureView::update_analysis() {
  // Moves are no noise: neither a spectrum nor figures of their bytes mean anything.
  if (is_retarget(*texture_)) return;
  const bool volume = whole_stack_ && slice_count(*texture_, section_.cut) > 1;
  const AnalysisKey wanted{section_.cut, first_channel(section_), volume ? -1 : slice_};
  if (wanted == analysed_ || (playing_ && !volume)) return;
  analysed_ = wanted;
  analysing_.start([texture = texture_, wanted](const Execution& execution) {
    return analyse_texture(*texture, wanted.cut, wanted.channel, wanted.index, execution);
  });
}

void TextureView::draw(App& app) {
  update(app);
  if (!texture_) {
    begin_panel("empty");
    begin_centred("what to do", "No texture yet");
    note(loading_.running()
             ? "Reading …"
             : "Drop a texture here: a mask, a retarget tile or atlas, a volume, a folder of slices.");
    if (button("Open a texture …")) app.ask_open();
    end_centred();
    end_panel();
    return;
  }
  const bool stack = slice_count(*texture_, section_.cut) > 1 && motion_range(*texture_) == 0;
  if (shortcut("space") && stack) playing_ = !playing_;

  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const bool narrow = room.x < em(kNarrowEm);
  const float facts = narrow ? std::max(em(20), room.x * 0.42f) : em(25);
  const float spectrum = narrow ? 0.0f : std::clamp(room.x * 0.27f, em(17), em(36));
  const float picture = room.x - facts - gap - (narrow ? 0.0f : spectrum + gap);
  begin_panel("picture", {picture, 0});
  draw_picture(ImGui::GetContentRegionAvail());
  end_panel();
  ImGui::SameLine();
  if (!narrow) {
    begin_panel("spectrum", {spectrum, 0});
    draw_spectrum(ImGui::GetContentRegionAvail());
    end_panel();
    ImGui::SameLine();
  }
  begin_panel("facts", {0, 0});
  // Pictures before figures, and a glimpse of the figures, to tell that there is more.
  if (narrow) {
    const ImVec2 rest = ImGui::GetContentRegionAvail();
    draw_spectrum({rest.x, std::max(em(18), rest.y - em(3))});
  }
  draw_facts(app);
  end_panel();
}

void TextureView::draw_picture(ImVec2 size) {
  const float top = ImGui::GetCursorPosY();
  draw_link_controls(link_);
  draw_pixel_controls();
  draw_section_controls();
  const float controls = ImGui::GetCursorPosY() - top;
  const bool has_range = picture_.has_range();
  const float gap = ImGui::GetStyle().ItemSpacing.y, histogram = has_range ? em(3.2f) : 0.0f;
  const float fields = has_range ? ImGui::GetFrameHeightWithSpacing() + gap : 0.0f;
  picture_.draw("Picture", link_, {size.x, size.y - controls - histogram - fields - gap});
  picture_.draw_range("Range", histogram);
  set_label_width(0);
  picture_.draw_range_fields();
  set_label_width(8);
}

void TextureView::draw_section_controls() {
  set_label_width(0);
  draw_channel_buttons();
  if (motion_range(*texture_) > 0) {
    set_label_width(5);
    draw_motion_controls();
    set_label_width(8);
    return;
  }
  const int slices = slice_count(*texture_, section_.cut);
  if (slices > 1) {
    int cut = section_.xz ? 1 : 0;
    if (choice("Cut", kCuts, cut, "XY: one slice. XZ: one row of every slice, time downwards"))
      section_.xz = cut == 1;
    ImGui::SameLine();
    if (button(playing_ ? "Pause" : "Play", true, "Space")) playing_ = !playing_;
    ImGui::SameLine();
    if (section_.xz) {
      slider("Row", row_, 0, slice_size(*texture_, section_.cut).height - 1);
    } else {
      slider("Slice", slice_, 0, slices - 1);
    }
  }
  set_label_width(8);
}

void TextureView::draw_pixel_controls() {
  if (picture_.picture()->hex_digits > 0) {
    flow(em(5), em(1));
    checkbox("Hex", link_.hex, "Values as hexadecimal numbers");
  }
  flow(em(11), em(1));
  set_label_width(0);
  const Extent size = picture_.picture()->size;
  if (field("Go to", go_to_, "A pixel: x, y. It is pinned; empty: none is")) {
    const auto pixel = pixel_of(go_to_, size);
    go_to_refused_ = !pixel && !go_to_.empty();
    if (pixel) {
      link_.go_to(*pixel, size);
    } else if (go_to_.empty()) {
      link_.pinned.reset();
    }
  }
  if (go_to_refused_)
    complaint("No such pixel",
              fmt::format("A pixel is \"x, y\", 0..{} and 0..{}.", size.width - 1, size.height - 1));
}

void TextureView::draw_channel_buttons() {
  const int count = shown_channels(*texture_);
  if (count < 2) return;
  const unsigned there = (1u << count) - 1;
  const bool has_moves = holds_moves(*texture_), moves = has_moves && section_.moves;
  bool first = true;
  const auto word = [&](const char* name, bool on, const char* hint) {
    ImGui::SameLine(0, std::exchange(first, false) ? em(0.6f) : 1.0f);
    const bool clicked = toggle(name, on, hint);
    items::record(fmt::format("Channel: {}", name), on ? "on" : "off");
    return clicked;
  };
  ImGui::AlignTextToFramePadding();
  note("Channel");
  if (has_moves && word("Moves", moves, "As hues: where each seed goes")) section_.moves = true;
  if (word("All", !moves && section_.channels == there, "All channels, each in its colour"))
    section_.moves = false, section_.channels = there;
  for (int c = 0; c < count; ++c) {
    const unsigned bit = 1u << c;
    const bool on = !moves && section_.channels != there && (section_.channels & bit) != 0;
    if (!word(kChannels[static_cast<std::size_t>(c)], on,
              "This channel in grey; with Ctrl to or from others"))
      continue;
    const bool adds = ImGui::GetIO().KeyCtrl && !moves && section_.channels != there;
    const unsigned wanted = adds ? section_.channels ^ bit : bit;
    section_.moves = false;
    if (wanted != 0) section_.channels = wanted;
  }
}

std::string TextureView::channel_text() const {
  if (shown_channels(*texture_) < 2) return "";
  return fmt::format("of channel {}", kChannels[static_cast<std::size_t>(first_channel(section_))]);
}

void TextureView::draw_spectrum(ImVec2 size) {
  if (is_retarget(*texture_)) return draw_moves(size);
  set_label_width(0);
  if (slice_count(*texture_, section_.cut) > 1) {
    int which = whole_stack_ ? 0 : 1;
    constexpr std::array<const char*, 2> kWords{"All slices", "This one"};
    if (choice("Spectrum of", kWords, which)) whole_stack_ = which == 0;
  }
  if (const std::string of = channel_text(); !of.empty()) {
    note("Spectrum " + of);
    items::record("Spectrum of channel", of);
  }
  set_label_width(8);
  const float side = std::min(size.x, size.y * 0.55f);
  spectrum_.draw("Spectrum", spectrum_link_, {size.x, side});
  if (analysis_) {
    Figure figure{.title = "Power",
                  .x = {.name = analysis_->time.power.empty() ? "cycles/pixel" : "cycles/pixel, cycles/frame",
                        .low = 0.0,
                        .high = 0.71},
                  .y = {.name = "power", .logarithmic = true}};
    figure.curves.push_back({.name = analysis_->time.power.empty() ? "in space" : "in a slice (mean)",
                             .colour = curve_colour(0),
                             .x = analysis_->radial.frequency,
                             .y = analysis_->radial.power});
    if (!analysis_->time.power.empty()) {
      figure.curves.push_back({.name = "in time",
                               .colour = curve_colour(1),
                               .x = analysis_->time.frequency,
                               .y = analysis_->time.power});
    }
    figure.levels.push_back({.name = "white", .colour = palette().dim_text, .y = 1.0});
    plot_.draw("Radial power", figure, {size.x, std::max(em(10), size.y - side - em(5))}, plot_link_);
  }
  if (analysing_.running()) note("Transforming …");
}

}  // namespace bn::ui
