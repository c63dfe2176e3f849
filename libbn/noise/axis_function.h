// The values of a kernel's functions along one axis of a torus.

#pragma once

#include <vector>

#include "bn/spatiotemporal.h"

namespace bn::noise {

/// f(0) .. f(side - 1), each the sum over all images: f(d) + f(d - side) + f(d + side) + ... Computed from
/// IEEE operations in a written order, so it has the same bits everywhere.
std::vector<double> wrapped(const AxisFunction& function, int side);

/// f(d) without any image, d >= 0. Not for AxisForm::one on an endless axis.
double unwrapped(const AxisFunction& function, int d);

/// Throws invalid_input, naming `where`, if the width is none of the form's.
void check(const AxisFunction& function, const char* where);

}  // namespace bn::noise
