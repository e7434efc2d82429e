#include "cli/web/page.hpp"

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/web/random_token.hpp"
#include "lang/text/replace_all.hpp"

namespace sdlc::cli {

// Of page.html, page.css and page.js.
extern const std::string_view kPageHtml, kPageCss, kPageJs;

WebResource page(std::string_view host) {
  const std::string nonce = random_token();
  std::string html(kPageHtml);
  html = lang::replace_all(std::move(html), "@nonce@", nonce);
  html = lang::replace_all(std::move(html), "@style@", kPageCss);
  html = lang::replace_all(std::move(html), "@script@", kPageJs);
  // Only what is in the page runs. The WebSocket is named for browsers whose 'self' lacks it.
  return {.type = "text/html",
          .body = std::move(html),
          .policy =
              fmt::format("default-src 'none'; script-src 'nonce-{0}'; style-src 'nonce-{0}'; "
                          "img-src data:; connect-src 'self' ws://{1}; base-uri 'none'; "
                          "form-action 'none'; frame-ancestors 'self' vscode-file: vscode-webview: "
                          "https://*.vscode-cdn.net",
                          nonce, host)};
}

}  // namespace sdlc::cli
