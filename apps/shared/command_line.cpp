#include "apps/shared/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/shared/manual.h"
#include "apps/shared/program.h"
#include "apps/shared/version.h"

namespace swell::apps {
namespace {

using Texts = std::vector<std::string>;

[[noreturn]] void refuse(std::string_view what, std::string_view got, const Texts& allowed,
                         std::string_view more = "") {
  throw OptionError(fmt::format("command line: {}, got '{}', allowed {}{}", what, got,
                                fmt::join(allowed, ", "), more));
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
  if (!modes.empty() && !is_option(extras.front())) refuse("unknown mode", extras.front(), modes);
  // An unknown option's value comes after it.
  const auto option = std::ranges::find_if(extras, is_option);
  if (option == extras.end()) refuse("unknown argument", extras.front(), options);
  refuse("unknown option", *option, options, modes.empty() ? "" : "; a mode's own come after it");
}

// Throws for an option that was given more often than once.
void check_once(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->get_items_expected_max() == 1 && option->count() > 1)
      throw OptionError(fmt::format("command line: {}, got it {} times, allowed once",
                                    option->get_name(), option->count()));
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& purpose)
    : app_(std::make_shared<CLI::App>(purpose, program)) {
  app_->set_version_flag("--version", program + " " + full_version());
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
  try {
    app_->parse(argc, argv);
    return true;
  } catch (const CLI::Success& request) {  // --help, --version
    app_->exit(request);
    return false;
  } catch (const CLI::ParseError& e) {
    // An unknown option before what may be missing only because of it.
    check_no_extras(*app_);
    for (const CLI::App* mode : app_->get_subcommands()) check_no_extras(*mode);
    check_once(*app_);
    for (const CLI::App* mode : app_->get_subcommands()) check_once(*mode);
    if (argc < 2 && app_->get_require_subcommand_min() > 0)
      throw OptionError("command line: got no mode, allowed those that --help lists");
    throw OptionError(std::string("command line: ") + e.what());
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
