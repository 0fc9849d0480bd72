// Says what is wrong with arguments. CLI11's own message for `scanbench rnu` is only that a subcommand is required.
#include "app/parse_fault.hpp"

#include <algorithm>
#include <cstddef>

#include "core/names.hpp"

namespace scanbench::app {
namespace {

std::string in_quotes(const std::string& text) {
  return "'" + text + "'";
}

/// The message about the first option that the verb does not have, with the nearest one that it has; empty if there is
/// none.
std::string unknown_option(const ParseFault& fault) {
  Words known;
  for (const OptionDescription& option : fault.verb.options)
    for (const Words& names : {option.long_names, option.short_names})
      known.insert(known.end(), names.begin(), names.end());
  for (std::size_t i = 1; i < fault.argv.size(); ++i) {
    const std::string name = fault.argv[i].substr(0, fault.argv[i].find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::count(known, name) > 0) continue;
    const std::string subject =
        fault.verb.path.empty() ? "there is no option " : in_quotes(fault.verb.path) + " has no option ";
    return subject + in_quotes(name) + known_names(name, known);
  }
  return "";
}

/// "there is no verb 'rnu'; did you mean 'run'?"; empty if the chosen verb has no verbs.
std::string missing_verb(const ParseFault& fault) {
  const std::string& path = fault.verb.path;
  const auto depth =
      1 + static_cast<std::size_t>(!path.empty()) + static_cast<std::size_t>(std::ranges::count(path, ' '));
  const bool is_given = fault.argv.size() > depth;
  const std::string given = is_given ? fault.argv[depth] : "";
  if (fault.verb.verbs.empty() || given.starts_with('-')) return "";
  Words names;
  for (const VerbDescription& verb : fault.verb.verbs) names.push_back(verb.name);
  const std::string owner = path.empty() ? "" : in_quotes(path) + ": ";
  return owner + (is_given ? "there is no verb " + in_quotes(given) : "a verb is missing") + known_names(given, names);
}

/// "'compare' takes no argument 'c.json'; --json has no value"; empty if there are no such arguments.
std::string extra_argument(const ParseFault& fault) {
  if (fault.extras.empty()) return "";
  const std::string& extra = fault.extras.front();
  const std::string text = in_quotes(fault.verb.path) + " takes no further argument " + in_quotes(extra);
  const auto at = std::ranges::find(fault.argv, extra);
  if (at == fault.argv.begin() || at == fault.argv.end()) return text;
  const std::string& before = *(at - 1);
  const bool follows_flag = std::ranges::any_of(fault.verb.options, [&](const OptionDescription& option) {
    return !option.has_value &&
           std::ranges::count(option.long_names, before) + std::ranges::count(option.short_names, before) > 0;
  });
  return follows_flag ? text + "; " + before + " has no value" : text;
}

}  // namespace

std::string renamed_option(const ParseFault& fault) {
  for (const std::string& argument : fault.argv)
    if (const auto now = fault.renamed.find(argument.substr(0, argument.find('='))); now != fault.renamed.end())
      return now->second;
  return "";
}

std::string message_of(const ParseFault& fault) {
  // A misspelt option that is required is both unknown and missing: the name that is wrong helps more.
  if (fault.is_required || !fault.extras.empty())
    if (const std::string text = unknown_option(fault); !text.empty()) return text;
  if (!fault.is_required) return extra_argument(fault);
  if (!fault.missing.empty()) return in_quotes(fault.verb.path) + " needs " + fault.missing.front();
  return missing_verb(fault);
}

}  // namespace scanbench::app
