// Writes completion scripts for bash, zsh and fish.
#include "app/verbs/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "core/names.hpp"

namespace scanbench::app {
namespace {

/// The program itself, its verbs and those below them; the program has the path "".
std::vector<VerbDescription> all_verbs(const ProgramDescription& text) {
  VerbDescription program = text.program;
  program.path.clear();
  program.verbs = text.verbs;
  std::vector<VerbDescription> all{program};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<VerbDescription> below = all[i].verbs;  // a copy: `all` grows
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

Words names_of(const OptionDescription& option) {
  Words names = option.long_names;
  names.insert(names.end(), option.short_names.begin(), option.short_names.end());
  return names;
}

/// What the words that are not options can be: verbs, or the names that the verb declares.
Words words_of(const VerbDescription& verb) {
  Words words;
  for (const VerbDescription& each : verb.verbs) words.push_back(each.name);
  for (const OptionDescription& option : verb.options) {
    if (!option.long_names.empty() || !option.short_names.empty()) continue;
    const Words more = option.words ? option.words() : option.choices;
    words.insert(words.end(), more.begin(), more.end());
  }
  return words;
}

/// The first sentence of a help text, for shells that show one beside each word.
std::string brief(const std::string& help) {
  return help.substr(0, std::min(help.find(':'), help.find(';')));
}

/// In single quotes, as bash and zsh read them.
std::string in_single_quotes(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// In single quotes, as fish reads them.
std::string fish_quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  return word + "'";
}

/// "'sweep'|'sweep plan'": a pattern of `case` for every verb.
std::string path_pattern(const std::vector<VerbDescription>& verbs) {
  Words paths;
  for (const VerbDescription& verb : verbs)
    if (!verb.path.empty()) paths.push_back(in_single_quotes(verb.path));
  return join(paths, "|");
}

/// The part that bash and zsh have in common: `at` becomes the verb before the word that is completed.
std::string find_path(const std::vector<VerbDescription>& verbs, const std::string& range, const std::string& words) {
  return fmt::format(
      "  for {0}; do\n"
      "    [[ ${{{1}[i]}} == -* ]] && continue\n"
      "    case ${{at:+$at }}${{{1}[i]}} in\n"
      "      {2}) at=${{at:+$at }}${{{1}[i]}} ;;\n"
      "      *) break ;;\n"
      "    esac\n"
      "  done\n",
      range, words, path_pattern(verbs));
}

/// Cases of "verb:option" for options with a list of values; `action` has a place for the list.
std::string value_cases(const std::vector<VerbDescription>& verbs, fmt::format_string<std::string> action) {
  std::string out;
  for (const VerbDescription& verb : verbs)
    for (const OptionDescription& option : verb.options) {
      if (option.choices.empty()) continue;
      for (const std::string& name : names_of(option))
        out += fmt::format("    {}) {} ;;\n", in_single_quotes(verb.path + ":" + name),
                           fmt::format(action, join(option.choices, " ")));
    }
  return out;
}

std::string bash_script(const std::vector<VerbDescription>& verbs) {
  std::string cases;
  for (const VerbDescription& verb : verbs) {
    Words options;
    for (const OptionDescription& option : verb.options)
      for (const std::string& name : names_of(option)) options.push_back(name);
    cases += fmt::format("    {}) words={} options={} ;;\n", in_single_quotes(verb.path),
                         in_single_quotes(join(words_of(verb), " ")), in_single_quotes(join(options, " ")));
  }
  return "# Completion of scanbench's command line for bash: source <(scanbench completion bash)\n"
         "_scanbench() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} at= words= options= i\n" +
         find_path(verbs, "((i = 1; i < COMP_CWORD; ++i))", "COMP_WORDS") + "  case $at in\n" + cases +
         "  esac\n"
         "  case $at:$before in\n" +
         value_cases(verbs, "words='{}' options=''") +
         "  esac\n"
         "  if [[ $word == -* ]]; then words=$options; fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "}\n"
         "complete -o default -F _scanbench scanbench\n";
}

/// "'plan:Divides the cells'": a word and what is said of it, for _describe.
std::string described_word(const std::string& word, const std::string& help) {
  return in_single_quotes(word + ":" + brief(help));
}

std::string zsh_script(const std::vector<VerbDescription>& verbs) {
  std::string cases, with_value;
  for (const VerbDescription& verb : verbs) {
    Words words, options, files;
    for (const VerbDescription& each : verb.verbs) words.push_back(described_word(each.name, each.help));
    if (verb.verbs.empty())
      for (const std::string& word : words_of(verb)) words.push_back(in_single_quotes(word));
    for (const OptionDescription& option : verb.options)
      for (const std::string& name : names_of(option)) {
        options.push_back(described_word(name, option.help));
        if (option.has_value && option.choices.empty()) files.push_back(in_single_quotes(verb.path + ":" + name));
      }
    cases += fmt::format("    {}) words_=({}) options_=({}) ;;\n", in_single_quotes(verb.path), join(words, " "),
                         join(options, " "));
    if (!files.empty()) with_value += "    " + join(files, "|") + ") _files; return ;;\n";
  }
  return "#compdef scanbench\n"
         "# Completion of scanbench's command line for zsh: source <(scanbench completion zsh)\n"
         "_scanbench() {\n"
         "  local at= i\n"
         "  local -a words_ options_\n" +
         find_path(verbs, "((i = 2; i < CURRENT; ++i))", "words") + "  case $at in\n" + cases +
         "  esac\n"
         "  case $at:${words[CURRENT-1]} in\n" +
         value_cases(verbs, "compadd -- {}; return") + with_value +
         "  esac\n"
         "  if [[ ${words[CURRENT]} == -* ]]; then _describe -o option options_; return; fi\n"
         "  if (($#words_)); then _describe word words_; else _files; fi\n"
         "}\n"
         "if [[ ${funcstack[1]:-} == _scanbench ]]; then _scanbench \"$@\"; else compdef _scanbench scanbench; fi\n";
}

/// A line of fish for a verb: `complete` with what it says.
std::string fish_line(const VerbDescription& verb, const std::string& what) {
  return fmt::format("complete -c scanbench -n {} {}\n", fish_quoted("__scanbench_at " + fish_quoted(verb.path)), what);
}

std::string fish_option(const OptionDescription& option) {
  std::string what;
  for (const std::string& name : option.long_names) what += "-l " + name.substr(2) + " ";
  for (const std::string& name : option.short_names) what += "-s " + name.substr(1) + " ";
  if (!option.choices.empty())
    what += "-x -a " + fish_quoted(join(option.choices, " ")) + " ";
  else if (option.has_value)
    what += "-r ";
  return what + "-d " + fish_quoted(brief(option.help));
}

std::string fish_script(const std::vector<VerbDescription>& verbs) {
  Words paths;
  std::string lines;
  for (const VerbDescription& verb : verbs) {
    if (!verb.path.empty()) paths.push_back(fish_quoted(verb.path));
    for (const VerbDescription& each : verb.verbs)
      lines += fish_line(verb, "-f -a " + each.name + " -d " + fish_quoted(brief(each.help)));
    if (const Words words = words_of(verb); verb.verbs.empty() && !words.empty())
      lines += fish_line(verb, "-f -a " + fish_quoted(join(words, " ")));
    for (const OptionDescription& option : verb.options)
      if (!names_of(option).empty()) lines += fish_line(verb, fish_option(option));
  }
  return "# Completion of scanbench's command line for fish: scanbench completion fish | source\n"
         "function __scanbench_at\n"
         "    set -l at ''\n"
         "    for word in (commandline -opc)[2..]\n"
         "        string match -q -- '-*' $word; and continue\n"
         "        set -l next (string trim -- \"$at $word\")\n"
         "        contains -- $next " +
         join(paths, " ") +
         "; or break\n"
         "        set at $next\n"
         "    end\n"
         "    test \"$at\" = \"$argv[1]\"\n"
         "end\n" +
         lines;
}

}  // namespace

std::string completion_script(const ProgramDescription& text, const std::string& shell) {
  const std::vector<VerbDescription> verbs = all_verbs(text);
  if (shell == "zsh") return zsh_script(verbs);
  if (shell == "fish") return fish_script(verbs);
  return bash_script(verbs);
}

}  // namespace scanbench::app
