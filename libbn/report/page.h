// The page around the sections.

#pragma once

#include <string>
#include <vector>

#include "report/section.h"

namespace bn::report {

struct Page {
  std::string title = "Texture report";
  std::string introduction =  ///< HTML
      "Power is |F|²/(N·variance), so white noise reads 1 at every frequency; frequencies are in "
      "cycles/pixel. The grade is 100 where a texture is as good as the best known of its size, 0 where it "
      "is no "
      "better than white noise.<span class=\"screen\"> A click on a picture shows it larger.</span>";
  std::string preface = {};        ///< HTML between the notes and the table at the top
  std::string appendix = {};       ///< HTML between that table and the sections
  std::vector<std::string> names;  ///< of the sections
  std::vector<std::string> kinds;  ///< "mask", "retarget set", "volume"
  std::vector<Section> sections;
  std::vector<std::string> notes;
  std::string common_caption;            ///< which textures the common plots show
  Plot common_power, common_anisotropy;  ///< for --compare; without curves otherwise
  bool compare = false;
};

/// `svg`: one a plot, the sections' in their order and then the common ones; empty: no plots.
std::string page_html(const Page& page, const std::vector<std::string>& svg);

}  // namespace bn::report
