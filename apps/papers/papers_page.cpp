#include <fmt/core.h>

#include "apps/papers/paper.h"
#include "apps/shared/xml_text.h"

namespace swell::apps {
namespace {

const char* relation(Agreement agreement) {
  switch (agreement) {
    case Agreement::kSame:
      return "";
    case Agreement::kAtMost:
      return "at most ";
    case Agreement::kAtLeast:
      return "at least ";
  }
  return "";
}

std::string number_row(const PaperNumber& n) {
  return fmt::format("<tr><td>{}</td><td>{}{:.6g} {}</td><td>{:.6g} {}</td><td>{}</td></tr>\n",
                     xml_text(n.what), relation(n.agreement), n.paper, xml_text(n.unit), n.ours,
                     xml_text(n.unit), n.holds() ? "" : "differs");
}

std::string item_html(const PaperItem& item) {
  std::string html =
      fmt::format("<h3>{}</h3>\n<p>{}</p>\n", xml_text(item.number), xml_text(item.words));
  for (const std::string& picture : item.pictures)
    html += fmt::format("<img src=\"{}\" alt=\"{}\">\n", picture, xml_text(item.number));
  if (!item.numbers.empty()) {
    html += "<table><tr><th></th><th>paper</th><th>here</th><th></th></tr>\n";
    for (const PaperNumber& number : item.numbers) html += number_row(number);
    html += "</table>\n";
  }
  if (!item.difference.empty()) html += fmt::format("<p>{}</p>\n", xml_text(item.difference));
  if (!item.scene.empty()) html += fmt::format("<p class=\"scene\">{}</p>\n", xml_text(item.scene));
  return html;
}

}  // namespace

std::string papers_page(std::span<const Paper> papers) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<title>Four papers, made again</title>\n<style>\n"
      "body { font-family: sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; }\n"
      "img { max-width: 48%; margin: 0.3em; vertical-align: top; }\n"
      "td, th { text-align: left; padding: 0.1em 1em 0.1em 0; }\n"
      ".scene { color: #666; font-family: monospace; }\n</style></head>\n<body>\n"
      "<h1>Four papers, made again</h1>\n";
  for (const Paper& paper : papers) {
    html += fmt::format("<h2>{}</h2>\n", xml_text(paper.title));
    for (const PaperItem& item : paper.items) html += item_html(item);
  }
  return html + "</body></html>\n";
}

}  // namespace swell::apps
