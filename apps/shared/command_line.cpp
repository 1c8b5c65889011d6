#include "apps/shared/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/shared/manual.h"
#include "apps/shared/program.h"
#include "apps/shared/version.h"
#include "scene/file/spelling.h"
#include "scene/scene_error.h"

namespace swell::apps {
namespace {

using Texts = std::vector<std::string>;

template <class... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> text, Values&&... values) {
  throw OptionError("command line: " + fmt::format(text, std::forward<Values>(values)...));
}

[[noreturn]] void refuse_word(std::string_view what, std::string_view got, const Texts& allowed,
                              std::string_view more = "") {
  const std::vector<std::string_view> names(allowed.begin(), allowed.end());
  refuse("{}, got '{}'{}, allowed {}{}", what, scene::shortened(got),
         scene::did_you_mean(got.substr(0, got.find('=')), names), fmt::join(allowed, ", "), more);
}

// Throws for the first argument that is no option of this line, nor a mode.
void check_no_extras(const CLI::App& app) {
  const Texts extras = app.remaining();
  if (extras.empty()) return;
  Texts modes, options;
  for (const CLI::App* mode : app.get_subcommands([](const CLI::App*) { return true; }))
    modes.push_back(mode->get_name());
  for (const CLI::Option* option : app.get_options()) options.push_back(option->get_name());

  const auto is_option = [](const std::string& text) { return text.starts_with('-'); };
  if (!modes.empty() && !is_option(extras.front()))
    refuse_word("unknown mode", extras.front(), modes);
  // An unknown option's value comes after it.
  const auto option = std::ranges::find_if(extras, is_option);
  if (option == extras.end()) refuse_word("unknown argument", extras.front(), options);
  refuse_word("unknown option", *option, options,
              modes.empty() ? "" : "; a mode's own come after it");
}

// Throws for an option that was given more often than once.
void check_once(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->get_items_expected_max() == 1 && option->count() > 1)
      refuse("{}, got it {} times, allowed once", option->get_name(), option->count());
}

// Throws for options that do not go together, or of which one is missing.
void check_together(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_required() && option->count() == 0)
      refuse("{0}, got none, allowed {0} {1}", option->get_name(), option->get_type_name());
    if (option->count() == 0) continue;
    for (const CLI::Option* other : option->get_excludes())
      if (other->count() > 0)
        refuse("{}, got it with {}, allowed one of them", option->get_name(), other->get_name());
    for (const CLI::Option* other : option->get_needs())
      if (other->count() == 0)
        refuse("{0}, got it without {1}, allowed with {1}", option->get_name(), other->get_name());
  }
}

// Throws for what the library says of one option's values, 'NAME: ...' or '... NAME = VALUE'.
void check_values(const CLI::App& app, const std::string& fault) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name(), kind = option->get_type_name();
    if (fault.starts_with(name + ": "))
      refuse("{0}, got too few values, allowed {0} {1}", name, kind);
    if (const std::size_t at = fault.find(name + " = "); at != std::string::npos)
      refuse("{0}, got '{1}', allowed {0} {2}", name,
             scene::shortened(fault.substr(at + name.size() + 3)), kind);
  }
}

// Throws what is wrong with a line, or one of its modes', that the library refused.
void explain(const CLI::App& app, const std::string& fault) {
  check_no_extras(app);  // before what may be missing only because of it
  check_once(app);
  check_values(app, fault);
  check_together(app);
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& purpose)
    : app_(std::make_shared<CLI::App>(purpose, program)) {
  app_->set_version_flag("--version", program + " " + full_version(),
                         "Display program version information and exit; as JSON with --json");
}

CommandLine::CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

CommandLine CommandLine::add_mode(const std::string& name, const std::string& purpose) {
  app_->require_subcommand(1);
  return CommandLine(app_->get_subcommand_ptr(app_->add_subcommand(name, purpose)));
}

void CommandLine::add_text(const std::string& name, const std::string& kind, std::string& value,
                           const std::string& help) {
  app_->add_option(name, value, help)->type_name(kind);
}

void CommandLine::add_texts(const std::string& name, const std::string& kind, Texts& values,
                            const std::string& help) {
  app_->add_option(name, values, help)->type_name(kind)->allow_extra_args(false);
}

void CommandLine::add_pair(const std::string& name, std::vector<double>& value,
                           const std::string& help) {
  app_->add_option(name, value, help)->expected(2)->type_name("X Y");
}

void CommandLine::add_flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
}

void CommandLine::add_value(const Value& value) {
  CLI::Option* option = app_->add_option_function<std::string>(value.name, value.take, value.help);
  if (!value.kind.empty()) option->type_name(value.kind);
  if (!value.default_text.empty()) option->default_str(value.default_text);
}

void CommandLine::require(const std::string& name) { app_->get_option(name)->required(); }

void CommandLine::exclude(const std::string& name, const std::string& other) {
  app_->get_option(name)->excludes(app_->get_option(other));
}

void CommandLine::need(const std::string& name, const std::string& other) {
  app_->get_option(name)->needs(app_->get_option(other));
}

bool CommandLine::parse(int argc, char** argv) {
  const std::string_view only = argc == 2 ? argv[1] : "";
  if (only == "--man") return fmt::print("{}", manual_page(*app_, version())), false;
  if (only == "--bash-completion") return fmt::print("{}", bash_completion(*app_)), false;
  if (argc == 3 && std::string_view(argv[1]) == "--version" &&
      std::string_view(argv[2]) == "--json")
    return fmt::print("{}\n", version_json(app_->get_name())), false;
  try {
    app_->parse(argc, argv);
    return true;
  } catch (const CLI::Success& request) {  // --help, --version
    app_->exit(request);
    return false;
  } catch (const CLI::ParseError& e) {
    explain(*app_, e.what());
    for (const CLI::App* mode : app_->get_subcommands()) explain(*mode, e.what());
    if (argc < 2 && app_->get_require_subcommand_min() > 0)
      refuse("got no mode, allowed those that --help lists");
    refuse("{}", e.what());
  }
}

bool CommandLine::given() const { return app_->parsed(); }

Texts CommandLine::arguments_without(const Texts& left_out) const {
  Texts arguments;
  for (const CLI::Option* option : app_->get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::ranges::count(left_out, name) > 0) continue;
    if (!option->get_allow_extra_args() && option->get_items_expected_max() > 1) {  // add_texts
      for (const std::string& text : option->results())
        arguments.insert(arguments.end(), {name, text});
      continue;
    }
    arguments.push_back(name);
    const bool is_flag = option->get_items_expected_max() == 0;
    if (!is_flag)
      arguments.insert(arguments.end(), option->results().begin(), option->results().end());
  }
  return arguments;
}

}  // namespace swell::apps
