#include "ui/bake_view.h"

#include "ui/app.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {

void BakeView::draw(App&) { note("Recipes come here."); }

void BakeView::parameters(Parameters&) {}

}  // namespace bn::ui
