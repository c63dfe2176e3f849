#include "ui/compare_view.h"

#include "ui/app.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {

void CompareView::draw(App&) { note("Comparisons come here."); }

void CompareView::parameters(Parameters&) {}

}  // namespace bn::ui
