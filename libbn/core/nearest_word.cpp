// What somebody may have meant by a word that is not known.

#include <algorithm>
#include <numeric>

#include "bn/options.h"

namespace bn {
namespace {

/// Edits (insert, delete, replace, swap of neighbours) from a to b: Damerau 1964, restricted form.
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_word(std::string_view text, const std::vector<std::string>& words) {
  if (text.size() > 40) return "";
  // The beginning of one word only is that word, and so is what goes on after a whole one: --output is --out.
  std::string nearest;
  constexpr std::size_t kFewestLetters = 3;
  int related = 0;
  for (const std::string& word : words) {
    const std::size_t shared = std::min(text.size(), word.size());
    const std::size_t letters = shared - std::min(shared, word.find_first_not_of('-'));
    if (letters < kFewestLetters || text.substr(0, shared) != word.substr(0, shared)) continue;
    ++related;
    nearest = word;
  }
  if (related == 1) return nearest;
  nearest.clear();
  // A third of the letters may be wrong; beyond that a suggestion is a guess.
  int least = std::max(1, static_cast<int>(text.size()) / 3) + 1;
  for (const std::string& word : words) {
    const int distance = edit_distance(text, word);
    if (distance >= least) continue;
    least = distance;
    nearest = word;
  }
  return nearest;
}

}  // namespace bn
