// Elementary functions whose bits do not depend on the C library: only IEEE additions,
// multiplications and divisions, in a written order. libm's own results differ in the last place
// between versions, and one such difference at a rounding boundary would change a baked texture.

#pragma once

namespace bn {

/// e^x for -700 <= x <= 700, within 2 ulp. Below that range 0, above it e^700.
double reproducible_exp(double x);

/// The natural logarithm of x for 2^-1022 <= x < infinity, within 4 ulp (near x = 1 within 2^-53 absolute).
/// Below that range ln(2^-1022).
double reproducible_log(double x);

struct CosineSine {
  double cosine;
  double sine;
};
/// Of the angle that is so many turns, 0 <= turns <= 1; within 2^-52 absolute, exact at quarters of a turn.
CosineSine reproducible_turn(double turns);

}  // namespace bn
