// A channel on the command line: its number, or the name that the file gives it.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bn::tools {

/// "Z" where the file names its channels (EXR does), else the number.
std::string channel_label(int channel, const std::vector<std::string>& names);

/// The number of the channel that `word` means: a name of the file, or a number below `channels`. Errors:
/// invalid_input, with `file` and the channels that it has.
int find_channel(std::string_view word, int channels, const std::vector<std::string>& names,
                 const std::string& file);

}  // namespace bn::tools
