#include "report/page.h"

#include <fmt/format.h>

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

std::string summary_of(const Page& page) {
  std::string rows;
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    rows +=
        fmt::format("<tr><th scope=\"row\"><a href=\"#t{}\">{}</a></th><td class=\"extra\">{}</td>{}</tr>\n",
                    i + 1, escaped(page.names[i]), page.kinds[i], page.sections[i].summary);
  }
  return fmt::format("<div class=\"wide\"><table class=\"summary\"><tbody>{}</tbody></table></div>\n", rows);
}

std::string comparison_of(const Page& page, const std::vector<std::string>& svg, std::size_t first) {
  std::string cards;
  for (const Section& section : page.sections) {
    if (!section.card.empty()) cards += "<div class=\"card\">" + section.card + "</div>\n";
  }
  if (cards.empty()) return {};
  std::string plots;
  if (!page.common_power.curves.empty()) {
    plots = plot_figure(page.common_power, 0, "Radial power", "Mean over annuli, against white noise.") +
            plot_figure(page.common_anisotropy, 1, "Anisotropy",
                        "In dB; one isotropic texture scatters about 0.");
  }
  return filled(fmt::format("<section><h2>Side by side</h2>\n<div class=\"cards\">{}</div>\n<div "
                            "class=\"plots\">{}</div></section>\n",
                            cards, plots),
                svg, first);
}

}  // namespace

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
  html += summary_of(page);

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
