#include "ui/run_view.h"

#include "ui/app.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {

void RunView::draw(App&) { note("Runs come here."); }

void RunView::parameters(Parameters&) {}

}  // namespace bn::ui
