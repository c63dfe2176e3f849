// Random events: what nobody would think of doing, to find out whether the inspector survives it.

#include <algorithm>
#include <array>

#include "bn/random.h"
#include "ui/app.h"
#include "ui/items.h"
#include "ui/script.h"

namespace bn::ui {
namespace {

constexpr std::array kChords{"ctrl+1",    "ctrl+2",     "ctrl+3", "ctrl+4",    "ctrl+o", "ctrl+z",   "ctrl+y",
                             "ctrl+d",    "escape",     "enter",  "tab",       "space",  "left",     "right",
                             "up",        "down",       "f",      "backspace", "delete", "home",     "end",
                             "f1",        "f12",        "ctrl+a", "ctrl+x",    "ctrl+v", "pagedown", "pageup",
                             "ctrl+plus", "ctrl+minus", "ctrl+0"};
constexpr std::array kTexts{"0",
                            "1",
                            "7",
                            "64",
                            "-1",
                            "1e9",
                            "999999999999999999999",
                            "0.5",
                            "nan",
                            "inf",
                            "mask.png",
                            "out",
                            "",
                            "%s%n",
                            "ß∞",
                            "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"};
/// What would leave the folder in which the test takes place.
constexpr std::array kLeftAlone{"Up"};

}  // namespace

void Script::queue_random(App& app) {
  const auto draw = [&](std::size_t bound) {
    const auto bits = static_cast<std::uint32_t>(random_bits(random_seed_, 0, random_draws_++));
    return static_cast<std::size_t>(random_below(bits, static_cast<std::uint32_t>(bound)));
  };
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const auto anywhere = [&] {
    return ImVec2(static_cast<float>(draw(static_cast<std::size_t>(screen.x))),
                  static_cast<float>(draw(static_cast<std::size_t>(screen.y))));
  };
  const auto on_item = [&] {
    const auto names = items::names();
    for (int attempt = 0; attempt < 8 && !names.empty(); ++attempt) {
      const std::string& name = names[draw(names.size())];
      const Item* item = items::find(name);
      const bool fine = std::find(kLeftAlone.begin(), kLeftAlone.end(), name) == kLeftAlone.end();
      if (!fine || item == nullptr || !item->visible) continue;
      return ImVec2(item->min.x + (item->max.x - item->min.x) * static_cast<float>(draw(100)) / 100.0f,
                    item->min.y + (item->max.y - item->min.y) * static_cast<float>(draw(100)) / 100.0f);
    }
    return anywhere();
  };
  switch (draw(16)) {
    case 0:
      return queue_click(anywhere());
    case 1:
      return queue_click(on_item(), true);
    case 2:
      return queue_click(on_item(), false, true);  // types into a slider
    case 3:
      queue_click(on_item());
      return queue_click(mouse_);
    case 4: {
      const ImVec2 from = on_item(), to = anywhere();
      for (const ImVec2& at : {from, to, from, to}) inputs_.push_back({.mouse = at, .left = true});
      return inputs_.push_back({.mouse = to});
    }
    case 5:
      return inputs_.push_back({.mouse = on_item(), .wheel = static_cast<float>(draw(9)) - 4.0f});
    case 6:
    case 7:
      return queue_key(kChords[draw(kChords.size())]);
    case 8:
      return queue_text(kTexts[draw(kTexts.size())]);
    case 9:
      if (draw(4) > 0) return;
      ImGui::GetIO().DisplaySize = {static_cast<float>(200 + draw(900)), static_cast<float>(150 + draw(600))};
      if (draw(4) == 0) app.scale = 0.5 + 0.25 * static_cast<double>(draw(7));
      return;
    default:
      return queue_click(on_item());
  }
}

}  // namespace bn::ui
