// The parts of the page: page/*.html, *.css and *.js, which the build puts into the library.
#pragma once

namespace cleft::page_parts {

extern const char* const document;
extern const char* const style;
extern const char* const script;

}  // namespace cleft::page_parts
