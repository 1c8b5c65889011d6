// The page that a browser shows: the stream of pictures; keyboard and mouse go back.
#pragma once

#include <string>

namespace swell::serve {

// The content policy names `nonce`: script and style that carry it are the page's own.
std::string page_html(const std::string& nonce);

}  // namespace swell::serve
