#include "apps/shared/xml_text.h"

namespace swell::apps {

std::string xml_text(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    if (c == '&')
      xml += "&amp;";
    else if (c == '<')
      xml += "&lt;";
    else
      xml += c;
  }
  return xml;
}

}  // namespace swell::apps
