#include <locale>

#include <fmt/format.h>

// Of the templates that {fmt} declares in its headers and instantiates in its library, the one that
// the headers do not use.
template std::locale fmt::detail::locale_ref::get<std::locale>() const;
