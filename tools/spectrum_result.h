// What bn spectrum has found, and how it is printed.

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bn/error.h"
#include "bn/judgement.h"

namespace bn::tools {

/// One channel of one texture, or the average of all.
struct SpectrumRow {
  std::string file;  ///< or "average"
  int channel = 0;
  std::string channel_name = {};  ///< "Z" where the file names its channels; else empty
  bool only_channel = true;
  FiguresOfMerit figures;
  Grade grade;
  std::optional<Judgement> judgement;  ///< where a check was asked for
  std::string
      relation;  ///< to an earlier channel of its file, "is channel 0 moved by (5, 3)"; it fails a check
  std::string set_aside;     ///< why it is not judged: "an opaque alpha channel"; else empty
  std::string name() const;  ///< "rgba.png, channel 2"
};

/// Two channels of one file.
struct ChannelPair {
  std::string file;
  int first = 0, second = 0;
  std::string second_label;  ///< its name, or its number
  CrossSpectrum cross;
  std::string relation;  ///< what they have in common; empty: independent, or too small to tell
};

struct SpectrumResult {
  std::optional<Check> check;
  std::vector<SpectrumRow> rows;
  std::vector<ChannelPair> pairs;
  struct Fault {
    std::string file;
    ErrorInfo error;
  };
  std::vector<Fault> faults;  ///< files that could not be read or analysed
  std::vector<std::string> notes;
  /// What was done to all channels of a file: "the colours are multiplied by alpha ...".
  struct FileFinding {
    std::string file, text;
  };
  std::vector<FileFinding> file_findings;
};

/// Texts for people, at most 80 columns but for file names that are longer.
std::string to_text(const SpectrumResult& result);

/// For programs; docs/spectrum.md describes each member.
nlohmann::ordered_json to_json(const SpectrumResult& result);

/// Every texture that fails with its first reason, for one line on stderr; empty if none does.
std::vector<std::string> failures_of(const SpectrumResult& result);

}  // namespace bn::tools
