// The transform of one line, the brick that transform.cpp builds with.

#pragma once

#include <complex>
#include <memory>

namespace bn::spectrum {

/// Transforms of one length; T float or double. Not thread safe: each thread uses one of its own.
/// Neither direction scales: inverse(forward(x)) = length * x. Results and sources never overlap.
template <class T>
class LineFft {
 public:
  explicit LineFft(int length);
  ~LineFft();
  LineFft(LineFft&&) noexcept;
  LineFft& operator=(LineFft&&) noexcept;

  void forward(std::complex<T>* result, const std::complex<T>* source);
  void inverse(std::complex<T>* result, const std::complex<T>* source);
  /// Real data to frequencies 0..length/2, and back.
  void forward_real(std::complex<T>* result, const T* source);
  void inverse_real(T* result, const std::complex<T>* source);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bn::spectrum
