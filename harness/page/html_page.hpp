// The frame of all pages, with its styles and widgets: tables sort, filter and can be saved; figures open large.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scanbench::harness {

/// A complete, self-contained page: no request, light and dark, readable without JavaScript.
std::string html_page(const std::string& title, const std::string& body);

/// A line of links to parts of the page: id and title of each.
std::string contents(const std::vector<std::pair<std::string, std::string>>& parts);

/// A part of a page: the id of its heading, the heading, and what is below it.
struct PagePart {
  std::string id;
  std::string title;
  std::string body;
};

/// The contents, the parts that have a body, and html_facts().
std::string html_parts(const std::vector<PagePart>& parts,
                       const std::vector<std::pair<std::string, std::string>>& facts);

/// "How to get these numbers again".
std::string html_facts(const std::vector<std::pair<std::string, std::string>>& facts);
std::string markdown_facts(const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace scanbench::harness
