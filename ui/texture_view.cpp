#include "ui/texture_view.h"

#include "bn/texture.h"
#include "ui/app.h"
#include "ui/widgets.h"

namespace bn::ui {

void TextureView::open(App& app, const std::filesystem::path& path) try {
  const Levels levels = levels_of_channel(read_image(path).image, 0);
  Picture picture{.size = levels.value.size(), .channels = 1, .values = {}};
  for (const auto level : levels.value) picture.values.push_back(static_cast<float>(level));
  view_.set(std::move(picture));
  path_ = path;
} catch (...) {
  app.report_in_flight();
}

void TextureView::draw(App&) {
  draw_link_controls(link_);
  view_.draw("Picture", link_, {em(40), em(30)});
  view_.draw_range("Range", em(4));
}

void TextureView::parameters(Parameters& p) { link_.parameters(p); }

}  // namespace bn::ui
