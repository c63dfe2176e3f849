#include "ui/run_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "bn/palette.h"
#include "ui/flow.h"
#include "ui/parameters.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

/// Of the difference; 0: so that nearly all of it is seen.
constexpr std::array<int, 4> kGains{0, 1, 8, 64};

Picture picture_of(const Grid<std::int32_t>& levels) {
  Picture picture;
  picture.size = levels.size();
  picture.values.assign(levels.begin(), levels.end());
  picture.low = 0.0f;
  // Levels are 8 or 16 bit; others are shown up to their greatest.
  const std::int32_t most = levels.count() == 0 ? 0 : *std::max_element(levels.begin(), levels.end());
  picture.high = most < 256 ? 255.0f : static_cast<float>(std::max(most, 65535));
  return picture;
}

/// Calls visit(index of u, index of u + R(u)).
template <class Visit>
void for_each_move(const Grid<Offset>& move, Visit visit) {
  const auto [width, height] = move.size();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t from =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const Offset r = move[from];
      const int to_x = wrap(std::int64_t{x} + r.x, width), to_y = wrap(std::int64_t{y} + r.y, height);
      visit(from, static_cast<std::size_t>(to_y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(to_x));
    }
  }
}

}  // namespace

Picture permuted_picture(const Grid<std::int32_t>& levels, const Grid<Offset>& move) {
  Picture picture = picture_of(levels);
  for_each_move(
      move, [&](std::size_t from, std::size_t to) { picture.values[to] = static_cast<float>(levels[from]); });
  return picture;
}

Picture target_picture(const Grid<std::int32_t>& levels, Offset step) {
  Picture picture = picture_of(levels);
  std::size_t at = 0;
  for (int y = 0; y < levels.height(); ++y) {
    for (int x = 0; x < levels.width(); ++x) {
      picture.values[at++] =
          static_cast<float>(levels.torus(std::int64_t{x} + step.x, std::int64_t{y} + step.y));
    }
  }
  return picture;
}

Picture difference_picture(const Grid<std::int32_t>& levels, const Grid<Offset>& move, Offset step,
                           int gain) {
  Picture picture = permuted_picture(levels, move);
  const Picture target = target_picture(levels, step);
  for (std::size_t i = 0; i < picture.values.size(); ++i)
    picture.values[i] = std::abs(picture.values[i] - target.values[i]);
  const float all = picture.high;
  if (gain > 0) {
    picture.high = std::max(1.0f, std::round(all / static_cast<float>(gain)));
    return picture;
  }
  // Nearly all differences are below white, which is a power of two, so that it seldom changes in a run.
  std::vector<float> sorted = picture.values;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 199 / 200);
  std::nth_element(sorted.begin(), place, sorted.end());
  picture.high = std::min(all, std::exp2(std::ceil(std::log2(std::max(1.0f, *place)))));
  return picture;
}

double longest_move(const RetargetOptions& options) {
  return options.radius * (options.reach == Reach::euclidean ? 1.0 : std::numbers::sqrt2);
}

Picture offset_picture(const Grid<Offset>& move, const RetargetOptions& options) {
  Picture picture;
  picture.size = move.size();
  picture.channels = 2;
  const Offset m = options.motion;
  const double reach = longest_move(options);
  for (const Offset r : move) {
    picture.colours.push_back(screen_colour(move_colour({r.x - m.x, r.y - m.y}, reach)));
    picture.values.push_back(static_cast<float>(r.x));
    picture.values.push_back(static_cast<float>(r.y));
  }
  picture.overlay = [move, m, reach = static_cast<float>(reach)](ImDrawList& list, int x, int y,
                                                                 ImVec2 corner, float size) {
    const Offset r = move(x, y);
    const float dx = static_cast<float>(r.x - m.x), dy = static_cast<float>(r.y - m.y),
                length = std::hypot(dx, dy);
    const ImVec2 middle{corner.x + 0.5f * size, corner.y + 0.5f * size};
    const ImU32 ink = IM_COL32(0, 0, 0, 200);
    if (length == 0.0f) return list.AddCircleFilled(middle, 0.08f * size, ink);
    // As long as the move is far, so that an arrow stays in its texel.
    const float half = size * (0.12f + 0.3f * std::min(1.0f, length / reach)), ux = dx / length,
                uy = dy / length;
    const auto at = [&](float along, float across) {
      return ImVec2(middle.x + ux * along - uy * across, middle.y + uy * along + ux * across);
    };
    const float head = 0.5f * half;
    list.AddLine(at(-half, 0), at(half - head, 0), ink, std::max(1.0f, 0.06f * size));
    list.AddTriangleFilled(at(half, 0), at(half - head, 0.6f * head), at(half - head, -0.6f * head), ink);
  };
  return picture;
}

void RunPictures::parameters(Parameters& p) {
  link_.parameters(p, "run");
  p("run.spectrum_of", spectrum_of_, 0, 2);
  p("run.gain", gain_, 0, static_cast<int>(kGains.size()) - 1);
}

RunPictures::Made RunPictures::make(const Subject& subject, std::shared_ptr<const Picture> target) {
  const RetargetOptions& options = subject.options;
  const Grid<std::int32_t>& levels = subject.source->levels.value;
  // Before a run nothing but the motion has moved.
  const Grid<Offset> still = subject.placement ? Grid<Offset>() : Grid<Offset>(levels.size(), options.motion);
  const Grid<Offset>& move = subject.placement ? subject.placement->move : still;
  const auto shared = [](Picture picture) { return std::make_shared<const Picture>(std::move(picture)); };
  if (!target) target = shared(target_picture(levels, options.step));
  return {.of = subject,
          .permuted = shared(permuted_picture(levels, move)),
          .target = std::move(target),
          .difference = shared(difference_picture(levels, move, options.step, kGains[subject.gain])),
          .offsets = shared(offset_picture(move, options))};
}

void RunPictures::clear() {
  for (ImageView* view : {&permuted_, &target_, &difference_, &offsets_, &spectrum_}) view->clear();
  curve_.reset();
  make_.stop();
  transform_.stop();
  spectrum_stale_ = false;
  shown_ = making_ = {};
}

bool RunPictures::busy() const {
  const ImageView* const views[] = {&permuted_, &target_, &difference_, &offsets_, &spectrum_};
  return transform_.running() || make_.running() ||
         std::any_of(std::begin(views), std::end(views), [](const ImageView* view) { return view->busy(); });
}

void RunPictures::show(std::shared_ptr<const Source> source, const RetargetOptions& options,
                       std::shared_ptr<const Placement> placement) {
  // Five pictures and their spectrum take some 60 bytes a pixel.
  constexpr std::int64_t kMostShown = std::int64_t{8192} * 8192;
  too_large_ = source && source->levels.value.size().area() > kMostShown;
  if (too_large_) source.reset();
  wanted_ = {std::move(source), std::move(placement), options, static_cast<std::size_t>(gain_)};
  // Another image's pictures would stand beside this one's figures.
  if (wanted_.source != shown_.source && wanted_.source != making_.source) clear();
  take_pictures();
  take_spectrum();
}

/// What is wanted, made at once where that is quick; else off the window's thread, one after the other, so
/// that a run that goes on is seen going on.
void RunPictures::take_pictures() {
  std::optional<Made> made = make_.poll();
  if (wanted_.source && !make_.running() && !wanted_.same(making_)) {
    const bool has_target = made ? made->of.same_image(wanted_) : shown_.source && shown_.same_image(wanted_);
    auto target = !has_target ? nullptr : made ? made->target : target_.picture();
    making_ = wanted_;
    if (wanted_.source->levels.value.size().area() <= kAtOnce) {
      made = make(wanted_, std::move(target));
    } else {
      make_.start([subject = wanted_, target = std::move(target)](const Execution&) {
        return make(subject, target);
      });
    }
  }
  if (!made) return;
  if (target_.picture() != made->target) target_.set(made->target);
  permuted_.set(std::move(made->permuted));
  difference_.set(std::move(made->difference));
  offsets_.set(std::move(made->offsets));
  shown_ = std::move(made->of);
  spectrum_stale_ = true;
}

void RunPictures::take_spectrum() {
  if (auto transformed = transform_.poll()) {
    spectrum_.set(std::move(transformed->picture));
    curve_ = std::move(transformed->curve);
  }
  if (!spectrum_stale_ || transform_.running() || !shown_.source) return;
  spectrum_stale_ = false;
  const ImageView& from = spectrum_of_ == 0 ? permuted_ : spectrum_of_ == 1 ? target_ : difference_;
  transform_.start(
      [shown = from.picture()](const Execution& execution) {
        const std::vector<double> values(shown->values.begin(), shown->values.end());
        const PowerSpectrum power =
            power_spectrum(values, {shown->size.width, shown->size.height, 1}, execution);
        const Grid<std::uint8_t> grey = log_picture(power);
        Picture picture;
        picture.size = grey.size();
        picture.values.assign(grey.begin(), grey.end());
        picture.describe = [size = grey.size()](int x, int y) {
          return fmt::format("f = ({:.3f}, {:.3f})", static_cast<double>(x - size.width / 2) / size.width,
                             static_cast<double>(y - size.height / 2) / size.height);
        };
        return Transformed{std::move(picture), radial_power(power)};
      },
      1);
}

void RunPictures::draw_controls() {
  draw_link_controls(link_);
  set_label_width(0);
  static constexpr const char* kOf[] = {"permuted", "target", "difference"};
  flow(choice_width("Spectrum of", kOf), em(1.5f));
  if (choice("Spectrum of", kOf, spectrum_of_)) spectrum_stale_ = true;
  static constexpr const char* kGainWords[] = {"auto", "×1", "×8", "×64"};
  flow(choice_width("Difference", kGainWords), em(1.5f));
  choice("Difference", kGainWords, gain_,
         "Gain: with ×8 an eighth of all levels is white; auto: what is there. The scale stands below the "
         "picture");
}

void RunPictures::draw(ImVec2 size, bool ranges) {
  if (too_large_) return note("Images above 8192 × 8192 are annealed, but not shown.");
  const float before = ImGui::GetCursorPosY();
  draw_controls();
  draw_pictures({size.x, size.y - (ImGui::GetCursorPosY() - before)}, ranges);
}

void RunPictures::draw_controls_last(ImVec2 size) {
  if (too_large_) return note("Images above 8192 × 8192 are annealed, but not shown.");
  draw_pictures(size, false);
  draw_controls();
}

void RunPictures::draw_pictures(ImVec2 size, bool ranges) {
  constexpr int kPictures = 5;
  const float gap = ImGui::GetStyle().ItemSpacing.x, row_gap = ImGui::GetStyle().ItemSpacing.y;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float range = ranges ? em(2.5f) + row_gap : 0.0f;
  // As many columns as make the pictures largest.
  int columns = 1;
  float width = 0.0f, height = 0.0f;
  for (int c = 1; c <= kPictures; ++c) {
    const int rows = (kPictures + c - 1) / c;
    const float w = (size.x - gap * static_cast<float>(c - 1)) / static_cast<float>(c);
    const float h = std::max(em(7), size.y / static_cast<float>(rows) - line - range - row_gap);
    // Below the picture stands a line of values.
    if (c > 1 && std::min(w, h - line) < std::min(width, height - line)) continue;
    columns = c, width = w, height = h;
  }
  const std::tuple<const char*, ImageView*, ViewLink*, const char*> all[] = {
      {"Permuted", &permuted_, &link_, "The mask after the seeds have moved: at u + R(u) the level of u"},
      {"Target", &target_, &link_, "The next frame's mask: the same one, moved by the step"},
      {"Difference", &difference_, &link_, "Its sum is the energy (L1)"},
      {"Offsets", &offsets_, &link_, "Where each seed goes: the hue is the direction, grey is near"},
      {"Spectrum", &spectrum_, &spectrum_link_, "Power in decibels, frequency 0 in the middle"}};
  int i = 0;
  for (const auto& [name, view, link, hint] : all) {
    if (i++ % columns != 0) ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::TextUnformatted(name);
    tooltip(hint);
    if (view == &offsets_ && !view->empty()) {
      ImGui::SameLine();
      legend_.draw(ImGui::GetTextLineHeight(), longest_move(shown_.options));
    }
    view->draw(name, *link, {width, height});
    if (ranges) {
      ImGui::BeginChild(name, {width, em(2.5f)}, false,
                        ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
      view->draw_range(fmt::format("{} range", name).c_str(), em(2.2f));
      ImGui::EndChild();
    }
    ImGui::EndGroup();
  }
}

Figure RunPictures::spectrum_figure() const {
  Figure figure;
  static constexpr const char* kOf[] = {"permuted mask", "target", "difference"};
  figure.title = "Power";
  figure.x.name = "cycles/pixel";
  figure.y.logarithmic = true;
  figure.x.low = 0.0;
  figure.x.high = std::numbers::sqrt2 / 2;
  if (!curve_) return figure;
  Curve curve;
  curve.name = kOf[spectrum_of_];
  curve.colour = curve_colour(0);
  curve.x = curve_->frequency;
  curve.y = curve_->power;
  figure.curves.push_back(std::move(curve));
  figure.levels.push_back({.name = "white noise", .colour = palette().dim_text, .y = 1.0});
  return figure;
}

}  // namespace bn::ui
