#include "apps/shared/manual.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <vector>

namespace swell::apps {
namespace {

std::vector<const CLI::App*> modes_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

// Text as roff shows it: nothing of it is a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  const bool is_request = !out.empty() && (out.front() == '.' || out.front() == '\'');
  return is_request ? "\\&" + out : out;
}

std::string joined_names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

void add_option(const CLI::Option& option, std::string& page) {
  page += fmt::format(".TP\n.B {}", roff(option.get_name(false, true)));
  if (takes_value(option)) page += " \\fI" + roff(option.get_type_name()) + "\\fR";
  std::string text = option.get_description();
  if (!text.ends_with('.')) text += '.';
  if (option.get_required()) text += " Must be given.";
  if (!option.get_default_str().empty()) text += " Default: " + option.get_default_str() + ".";
  if (!option.get_needs().empty()) text += " Only with " + joined_names(option.get_needs()) + ".";
  if (!option.get_excludes().empty())
    text += " Not with " + joined_names(option.get_excludes()) + ".";
  page += fmt::format("\n{}\n", roff(text));
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  const std::string name = app.get_name();
  const auto modes = modes_of(app);
  std::string page =
      fmt::format(".TH {} 1 \"\" \"swell {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
                  roff(upper(name)), version, roff(name), roff(app.get_description()));
  page += fmt::format(".SH SYNOPSIS\n.B {}\n{}[OPTION]...\n.SH OPTIONS\n", roff(name),
                      modes.empty() ? "" : "MODE ");
  for (const CLI::Option* option : app.get_options()) add_option(*option, page);
  if (!modes.empty()) page += ".SH MODES\n";
  for (const CLI::App* mode : modes) {
    page += fmt::format(".SS {}\n{}\n", roff(mode->get_name()), roff(mode->get_description()));
    for (const CLI::Option* option : mode->get_options()) add_option(*option, page);
  }
  page +=
      ".SH EXIT STATUS\n0 if all is done, 2 for bad options, scenes or files, 1 for anything "
      "else.\n";
  return page;
}

std::string bash_completion(const CLI::App& app) {
  const auto words_of = [](const CLI::App& line) {
    std::string words;
    for (const CLI::Option* option : line.get_options()) words += option->get_name() + " ";
    return words;
  };
  std::string function = app.get_name();
  std::ranges::replace(function, '-', '_');
  std::string script =
      fmt::format("_{}() {{\n  local words mode=\"${{COMP_WORDS[1]}}\"\n", function);
  script += "  case \"$mode\" in\n";
  std::string first = words_of(app);
  for (const CLI::App* mode : modes_of(app)) {
    script += fmt::format("    {}) words=\"{}\" ;;\n", mode->get_name(), words_of(*mode));
    first += mode->get_name() + " ";
  }
  script += fmt::format("    *) words=\"{}\" ;;\n  esac\n", first);
  script +=
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
      "  if [[ $word == -* || $COMP_CWORD == 1 ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "  elif [[ $before == -* ]]; then\n"
      "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
      "  fi\n}\n";
  return script + fmt::format("complete -o filenames -F _{} {}\n", function, app.get_name());
}

}  // namespace swell::apps
