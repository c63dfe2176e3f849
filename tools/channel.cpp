#include "tools/channel.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "bn/error.h"
#include "bn/options.h"

namespace bn::tools {

std::string channel_label(int channel, const std::vector<std::string>& names) {
  const auto at = static_cast<std::size_t>(channel);
  return at < names.size() ? names[at] : std::to_string(channel);
}

int find_channel(std::string_view word, int channels, const std::vector<std::string>& names,
                 const std::string& file) {
  if (const auto named = std::find(names.begin(), names.end(), word); named != names.end())
    return static_cast<int>(named - names.begin());
  int number = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc{} && end == word.data() + word.size() && number >= 0 && number < channels)
    return number;
  const std::string nearest = nearest_word(word, names);
  throw Error(
      {.code = ErrorCode::invalid_input,
       .what = fmt::format("it has no channel {}", word),
       .where = file,
       .limit = fmt::format("{}{}0..{}", fmt::join(names, ", "), names.empty() ? "" : ", or ", channels - 1),
       .remedy = nearest.empty() ? "" : fmt::format("did you mean {}?", nearest)});
}

}  // namespace bn::tools
