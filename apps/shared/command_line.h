// A program's command line: which options it takes, and what was given for them. CLI11 is used
// here alone.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace swell::apps {

// A handle: copies stand for the same command line. The variables that options are stored in
// must outlive parse(); they keep their defaults where an option is not given. Each option but a
// flag takes a value and may be given once, but for add_texts.
class CommandLine {
 public:
  // A program with --help and --version.
  CommandLine(const std::string& program, const std::string& purpose);

  // One of the program's modes ("frame" in 'swell-bench frame'), of which one must be given. Its
  // options are its own, with --help among them. Use it only while the program's line lives.
  CommandLine add_mode(const std::string& name, const std::string& purpose);

  // A text; `kind` stands for it in the help text ("FILE").
  void add_text(const std::string& name, const std::string& kind, std::string& value,
                const std::string& help);

  // A text that may be given any number of times.
  void add_texts(const std::string& name, const std::string& kind, std::vector<std::string>& values,
                 const std::string& help);

  // Two numbers, "X Y"; empty if not given.
  void add_pair(const std::string& name, std::vector<double>& value, const std::string& help);

  void add_flag(const std::string& name, bool& value, const std::string& help);

  // A value that `take` reads; it throws OptionError at what it does not allow.
  struct Value {
    std::string name, kind, default_text, help;  // `default_text` as the help shows it, or empty
    std::function<void(const std::string&)> take;
  };
  void add_value(const Value& value);

  // These bind options that have been added: `name` must be given; not together with `other`; not
  // without it.
  void require(const std::string& name);
  void exclude(const std::string& name, const std::string& other);
  void need(const std::string& name, const std::string& other);

  // Reads main's arguments. False: --help or --version was asked for and has been printed; or
  // alone, for packages, --man or --bash-completion. Throws OptionError.
  bool parse(int argc, char** argv);

  // Whether this mode was given; after the program's parse().
  bool given() const;

  // Options as they were given, with their values, but for those left out: another program may
  // take them again.
  std::vector<std::string> arguments_without(const std::vector<std::string>& left_out) const;

 private:
  explicit CommandLine(std::shared_ptr<CLI::App> app);

  std::shared_ptr<CLI::App> app_;
};

}  // namespace swell::apps
