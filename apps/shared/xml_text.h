// Text in SVG and HTML.
#pragma once

#include <string>

namespace swell::apps {

// Text as XML takes it between tags.
std::string xml_text(const std::string& text);

}  // namespace swell::apps
