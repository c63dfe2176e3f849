#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "bn/version.h"
#include "report/html.h"

namespace bn::report {
namespace {

constexpr std::string_view kStyle =
#include "report/page.css.inc"
    ;

/// Puts drawings into the slots of `html`; `svg[first + i]` into slot i, a line of text where there is none.
std::string filled(std::string_view html, const std::vector<std::string>& svg, std::size_t first) {
  std::string result;
  while (true) {
    const auto at = html.find('\x01');
    if (at == std::string_view::npos) break;
    const auto end = html.find('\x02', at);
    result += html.substr(0, at);
    const auto index =
        first + static_cast<std::size_t>(std::atoi(std::string(html.substr(at + 1, end - at - 1)).c_str()));
    if (index < svg.size()) {
      result += svg[index];
    } else {
      result += "<p class=\"missing\">Not drawn: see the notes.</p>";
    }
    html.remove_prefix(end + 1);
  }
  return result.append(html);
}

std::string link_to(const Page& page, std::size_t section) {
  return fmt::format("<a href=\"#t{}\">{}</a>", section + 1, escaped(page.names[section]));
}

/// Sections that have no table of their own.
std::string plain_list(const Page& page) {
  std::string rows;
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    if (page.sections[i].group != Group::other) continue;
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", link_to(page, i), page.kinds[i]);
  }
  if (rows.empty()) return {};
  return fmt::format("<div class=\"wide\"><table class=\"summary\"><tbody>{}</tbody></table></div>\n", rows);
}

/// A group's table, textures by figures. It sorts without a script: each cell knows its place under every
/// heading, and the heading that is chosen decides which of them counts (page.css).
std::string overview_table(const Page& page, Group group, std::string_view name, int table) {
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    if (page.sections[i].group == group) members.push_back(i);
  }
  if (members.empty()) return {};
  const std::vector<std::string_view> columns = overview_columns(group);
  // places[c][m]: where member m stands when sorted by column c; column 0 is the name, in the order of the
  // page.
  std::vector<std::vector<std::size_t>> places(columns.size() + 1, std::vector<std::size_t>(members.size()));
  for (std::size_t m = 0; m < members.size(); ++m) places[0][m] = m + 1;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<std::size_t> order(members.size());
    for (std::size_t m = 0; m < order.size(); ++m) order[m] = m;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return page.sections[members[a]].overview[c].order < page.sections[members[b]].overview[c].order;
    });
    for (std::size_t m = 0; m < order.size(); ++m) places[c + 1][order[m]] = m + 1;
  }
  const bool sorts = members.size() > 1;
  std::string html = fmt::format(
      "<div class=\"wide\"><div class=\"overview\" role=\"table\" style=\"--columns:{}\">", columns.size());
  html += "<div class=\"row head\" role=\"row\">";
  for (std::size_t c = 0; c <= columns.size(); ++c) {
    const std::string heading(c == 0 ? name : columns[c - 1]);
    html += fmt::format("<span role=\"columnheader\" class=\"c{}\">", c);
    html += sorts ? fmt::format(
                        "<label title=\"Sort by this\"><input type=\"radio\" name=\"sort{}\" "
                        "class=\"s{}\"{}>{}</label></span>",
                        table, c, c == 0 ? " checked" : "", heading)
                  : heading + "</span>";
  }
  html += "</div>\n";
  for (std::size_t m = 0; m < members.size(); ++m) {
    std::string orders;
    for (std::size_t c = 0; sorts && c <= columns.size(); ++c)
      orders += fmt::format("--o{}:{};", c, places[c][m]);
    html += fmt::format(
        "<div class=\"row\" role=\"row\" style=\"{}\"><span role=\"rowheader\" class=\"c0\">{}</span>",
        orders, link_to(page, members[m]));
    for (std::size_t c = 0; c < columns.size(); ++c) {
      html += fmt::format("<span role=\"cell\" class=\"c{}\">{}</span>", c + 1,
                          page.sections[members[m]].overview[c].html);
    }
    html += "</div>\n";
  }
  return html + "</div></div>\n";
}

std::string summary_of(const Page& page) {
  return overview_table(page, Group::texture, "texture", 1) +
         overview_table(page, Group::retarget_set, "retarget set", 2) + plain_list(page);
}

std::string comparison_of(const Page& page, const std::vector<std::string>& svg, std::size_t first) {
  std::string cards;
  for (const Section& section : page.sections) {
    if (!section.card.empty()) cards += "<div class=\"card\">" + section.card + "</div>\n";
  }
  if (cards.empty()) return {};
  std::string plots;
  if (!page.common_power.curves.empty()) {
    plots = plot_figure(page.common_power, 0, "Radial power",
                        "Mean over annuli, against white noise." + page.common_caption) +
            plot_figure(page.common_anisotropy, 1, "Anisotropy",
                        "In dB; one isotropic texture scatters about 0.");
  }
  return filled(fmt::format("<section><h2>Side by side</h2>\n<div class=\"cards\">{}</div>\n<div "
                            "class=\"plots\">{}</div></section>\n",
                            cards, plots),
                svg, first);
}

}  // namespace

std::vector<std::string_view> overview_columns(Group group) {
  switch (group) {
    case Group::texture:
      return {"verdict", "grade",          "power, 0 &lt; <i>f</i> ≤ 0.0625",
              "… 0.125", "… 0.1875",       "… 0.25",
              "peak",    "anisotropy, dB", "histogram",
              "size"};
    case Group::retarget_set:
      return {"verdict", "energy", "of the start", "bound", "tiles", "seconds", "size"};
    case Group::other:
      break;
  }
  return {};
}

std::string page_html(const Page& page, const std::vector<std::string>& svg) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light "
      "dark\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'\">\n<meta name=\"generator\" content=\"bn {}\">\n<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n<header><h1>{}</"
      "h1>\n<p>Made "
      "by bn {}. {}</p></header>\n",
      kVersion, page.title, kStyle, page.title, kVersion, page.introduction);
  if (!page.notes.empty()) {
    html += "<aside class=\"notes\"><b>Notes</b><ul>";
    for (const std::string& note : page.notes) html += fmt::format("<li>{}</li>", escaped(note));
    html += "</ul></aside>\n";
  }
  html += page.preface + summary_of(page) + page.appendix;

  std::size_t plots = 0;
  for (const Section& section : page.sections) plots += section.plots.size();
  if (page.compare) html += comparison_of(page, svg, plots);
  std::size_t first = 0;
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    html +=
        fmt::format("<section id=\"t{}\">\n{}</section>\n", i + 1, filled(page.sections[i].html, svg, first));
    first += page.sections[i].plots.size();
  }
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace bn::report
