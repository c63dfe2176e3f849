#include "bake/kinds/alike.h"

namespace bn {

const std::vector<std::pair<std::string, SampleType>>& baking::sample_types() {
  static const std::vector<std::pair<std::string, SampleType>> types = {{"8bit", SampleType::u8},
                                                                        {"16bit", SampleType::u16},
                                                                        {"half", SampleType::f16},
                                                                        {"float", SampleType::f32}};
  return types;
}

Options baking::mask_output_options(SampleType& type) {
  Options options;
  options.choice<SampleType>("type", type, sample_types(), "What the samples of the file are.")
      .if_unset("float for .exr, else 8bit");
  return options;
}

void baking::complain_of(const ErrorInfo& refused, const Complain& complain) {
  complain(refused.where, "is refused: " + refused.what, refused.limit, refused.remedy);
}

}  // namespace bn
