// Pages in headless Chromium, for the tests that act on them.
#pragma once

#include <filesystem>
#include <string>

#include "tests/app/program.hpp"

namespace scanbench::app_test {

inline bool has_browser() {
  return fs::exists("/usr/bin/chromium");
}

/// Opens a page in headless Chromium, lets `script` act on it and returns the text that it leaves in the title.
inline std::string title_after(const fs::path& page, const std::string& script, const Folder& folder) {
  std::string html = read(page);
  html.replace(html.rfind("</body>"), 7, "<script>" + script + "</script></body>");
  const fs::path copy = folder.write("opened.html", html);
  const Outcome dom =
      Child({"/usr/bin/chromium", "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--user-data-dir=" + (folder / "profile").string(), "--dump-dom", "file://" + copy.string()},
            {}, folder.path())
          .wait();
  const auto from = dom.out.find("<title>");
  return from == std::string::npos ? dom.err : dom.out.substr(from + 7, dom.out.find("</title>") - from - 7);
}

}  // namespace scanbench::app_test
