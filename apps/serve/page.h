// The page that a browser shows: the stream of pictures; keyboard and mouse go back.
#pragma once

#include <string_view>

namespace swell::serve {

std::string_view page_html();

}  // namespace swell::serve
