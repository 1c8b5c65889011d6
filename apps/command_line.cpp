#include "apps/command_line.h"

#include <CLI/CLI.hpp>

#include "apps/program.h"

namespace swell::apps {

CommandLine::CommandLine(const std::string& program, const std::string& purpose)
    : app_(std::make_shared<CLI::App>(purpose, program)) {
  app_->set_version_flag("--version", program + " " + version());
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
  try {
    app_->parse(argc, argv);
    return true;
  } catch (const CLI::Success& request) {  // --help, --version
    app_->exit(request);
    return false;
  } catch (const CLI::ParseError& e) {
    throw OptionError(std::string("command line: ") + e.what());
  }
}

bool CommandLine::given() const { return app_->parsed(); }

}  // namespace swell::apps
