#include "bn_study/convergence_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bn/random.h"
#include "core/refuse.h"
#include "study/blur.h"

namespace bn {
namespace {

constexpr int kSteps = 64;                  // of heavisides
constexpr std::uint32_t kResetStream = 92;  // of random_bits

double square(double value) { return value * value; }

/// The mean square of a picture's error.
double mean_square(const Grid<float>& picture, double integral) {
  double sum = 0.0;
  for (const float value : picture) sum += square(value - integral);
  return sum / static_cast<double>(picture.count());
}

Grid<float> median_3(const Grid<float>& picture) {
  Grid<float> result(picture.size());
  std::array<float, 9> near{};
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      for (int i = 0; i < 9; ++i) {
        near[static_cast<std::size_t>(i)] =
            picture(wrap(x + i % 3 - 1, picture.width()), wrap(y + i / 3 - 1, picture.height()));
      }
      std::nth_element(near.begin(), near.begin() + 4, near.end());
      result(x, y) = near[4];
    }
  }
  return result;
}

/// What one integrand leaves; squares, whose roots are taken last.
class Renderer {
 public:
  Renderer(const SampleSource& source, const ConvergenceOptions& options, const Execution& execution)
      : source_(source), options_(options), execution_(execution) {}

  Convergence run(const Integrand& integrand) const {
    Convergence result{.source = source_.name, .integrand = std::string(integrand.name)};
    filtered_frames(integrand, 0, std::nullopt, [&](int, const Grid<float>& average) {
      result.filtered.push_back(mean_square(average, integrand.integral));
    });
    filtered_frames(integrand, source_.first.depth() / 3, std::nullopt, [&](int, const Grid<float>& average) {
      result.later.push_back(mean_square(average, integrand.integral));
    });
    filtered_frames(integrand, 0, options_.reset, [&](int frame, const Grid<float>& average) {
      if (frame >= options_.frames - options_.reset)
        result.moving += mean_square(average, integrand.integral) / options_.reset;
    });
    plain_frames(integrand, result);
    return result;
  }

 private:
  using Watch = std::function<void(int frame, const Grid<float>& average)>;

  Grid<float> picture(const Integrand& integrand, int frame) const {
    throw_if_stopped(execution_);
    const int slice = wrap(frame, source_.first.depth());
    const auto first = source_.first.slice(slice), second = source_.second.slice(slice);
    Grid<float> values(source_.first.size());
    std::transform(first.begin(), first.end(), second.begin(), values.begin(), integrand.value);
    return values;
  }

  /// Each frame blurred and averaged exponentially; with `reset`, pixel by pixel from new every so many
  /// frames.
  void filtered_frames(const Integrand& integrand, int start, std::optional<int> reset,
                       const Watch& watch) const {
    Blur blur(source_.first.size(), options_.filter.taps);
    const auto alpha = static_cast<float>(options_.filter.alpha);
    Grid<float> average(source_.first.size());
    for (int frame = 0; frame < options_.frames; ++frame) {
      Grid<float> now = picture(integrand, start + frame);
      blur.apply(now);
      for (std::size_t i = 0; i < now.count(); ++i) {
        const bool begins = frame == 0 || (reset && is_reset(i, frame, *reset));
        average[i] += (begins ? 1.0f : alpha) * (now[i] - average[i]);
      }
      watch(frame, average);
    }
  }

  static bool is_reset(std::size_t pixel, int frame, int every) {
    const auto phase = random_bits(1, kResetStream, pixel) % static_cast<std::uint64_t>(every);
    return (static_cast<std::uint64_t>(frame) + phase) % static_cast<std::uint64_t>(every) == 0;
  }

  /// Frames that nothing has blurred: their plain mean, and what denoisers leave of the exponential average.
  void plain_frames(const Integrand& integrand, Convergence& result) const {
    const Extent size = source_.first.size();
    Grid<float> average(size);
    Grid<double> sum(size);
    for (int frame = 0; frame < options_.frames; ++frame) {
      const Grid<float> now = picture(integrand, frame);
      double squares = 0.0;
      for (std::size_t i = 0; i < now.count(); ++i) {
        sum[i] += now[i];
        squares += square(sum[i] / (frame + 1.0) - integrand.integral);
        average[i] += (frame == 0 ? 1.0f : static_cast<float>(options_.filter.alpha)) * (now[i] - average[i]);
      }
      result.mean.push_back(squares / static_cast<double>(now.count()));
    }
    const std::array<std::vector<double>, 4> taps{FrameFilter::box_taps(3), FrameFilter::box_taps(5),
                                                  FrameFilter::gaussian_taps(1.0),
                                                  FrameFilter::gaussian_taps(2.0)};
    for (std::size_t i = 0; i < kDenoisers.size(); ++i) {
      Grid<float> denoised = average;
      if (i < taps.size()) {
        Blur(size, taps[i]).apply(denoised);
      } else {
        denoised = median_3(denoised);
      }
      result.denoised[i] = mean_square(denoised, integrand.integral);
    }
  }

  const SampleSource& source_;
  const ConvergenceOptions& options_;
  const Execution& execution_;
};

/// Calls body with every figure of the first and its equal in the second.
template <class Body>
void for_each_figure(Convergence& a, const Convergence& b, const Body& body) {
  for (auto series : {&Convergence::mean, &Convergence::filtered, &Convergence::later}) {
    (a.*series).resize((b.*series).size());
    for (std::size_t i = 0; i < (b.*series).size(); ++i) body((a.*series)[i], (b.*series)[i]);
  }
  body(a.moving, b.moving);
  for (std::size_t i = 0; i < kDenoisers.size(); ++i) body(a.denoised[i], b.denoised[i]);
}

void check(const SampleSource& source, const ConvergenceOptions& options) {
  if (options.frames < 2 || options.frames > 4096)
    refuse("frames", fmt::format("{} frames", options.frames), "2..4096");
  if (options.reset < 1 || options.reset > options.frames)
    refuse("reset", fmt::format("a reset every {} frames", options.reset),
           fmt::format("1..{}", options.frames));
  if (!(options.filter.alpha > 0.0 && options.filter.alpha <= 1.0))
    refuse("alpha", fmt::format("alpha {}", options.filter.alpha), "above 0, up to 1");
  if (source.first.shape() != source.second.shape())
    refuse(source.name, "first and second numbers of different shapes", "the same pixels and frames");
}

}  // namespace

std::span<const Integrand> integrands() {
  static const std::vector<Integrand> all{
      {"step", [](float x, float) { return x < 0.5f ? 1.0f : 0.0f; }, 0.5},
      {"ramp", [](float x, float) { return x; }, 0.5},
      {"triangle", [](float x, float y) { return y > x ? 1.0f : 0.0f; }, 0.5},
      {"disk", [](float x, float y) { return x * x + y * y < 0.636619772f ? 1.0f : 0.0f; }, 0.5},
      {"bilinear", [](float x, float y) { return x * y; }, 0.25},
      // The square of sqrt(pi) / 2 erf(1).
      {"gauss", [](float x, float y) { return std::exp(-x * x - y * y); }, 0.557746285351034},
  };
  return all;
}

std::vector<Convergence> study_convergence(const SampleSource& source, const ConvergenceOptions& options,
                                           const Execution& execution) {
  check(source, options);
  const Renderer renderer(source, options, execution);
  std::vector<Convergence> steps(kSteps), others(integrands().size());
  parallel_for(execution, kSteps + std::ssize(integrands()), [&](std::int64_t i) {
    if (i < kSteps) {
      const double tau = (static_cast<double>(i) + 0.5) / kSteps;
      const auto step = [tau](float x, float) { return x < static_cast<float>(tau) ? 1.0f : 0.0f; };
      steps[static_cast<std::size_t>(i)] = renderer.run({"heavisides", step, tau});
    } else {
      const auto at = static_cast<std::size_t>(i - kSteps);
      others[at] = renderer.run(integrands()[at]);
    }
  });
  std::vector<Convergence> results{{.source = source.name, .integrand = "heavisides"}};
  for (const Convergence& step : steps)
    for_each_figure(results[0], step, [](double& mean, double one) { mean += one / kSteps; });
  results.insert(results.end(), others.begin(), others.end());
  for (Convergence& result : results)
    for_each_figure(result, Convergence(result), [](double& figure, double) { figure = std::sqrt(figure); });
  return results;
}

std::string convergence_csv(std::span<const Convergence> rows) {
  std::string text = "source,integrand,frame,mean,filtered,later\n";
  for (const Convergence& row : rows) {
    for (std::size_t i = 0; i < row.mean.size(); ++i) {
      text += fmt::format("\"{}\",{},{},{:.6f},{:.6f},{:.6f}\n", row.source, row.integrand, i + 1,
                          row.mean[i], row.filtered[i], row.later[i]);
    }
  }
  return text;
}

std::string denoised_csv(std::span<const Convergence> rows) {
  std::string text = fmt::format("source,integrand,moving,{}\n", fmt::join(kDenoisers, ","));
  for (const Convergence& row : rows) {
    text += fmt::format("\"{}\",{},{:.6f}", row.source, row.integrand, row.moving);
    for (const double error : row.denoised) text += fmt::format(",{:.6f}", error);
    text += "\n";
  }
  return text;
}

}  // namespace bn
