#include "base/command/command_line.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "base/error.h"
#include "base/message.h"
#include "base/text.h"

namespace cleft {

namespace {

template <class Validator>
Check shared(Validator validator) {
  return std::make_shared<const CLI::Validator>(std::move(validator));
}

Check bounded(double least, bool open) {
  return shared(CLI::Validator(
      [=](const std::string& text) -> std::string {
        try {
          const double value = parse_number(text, "option");
          if (open ? value > least : value >= least) return {};
        } catch (const InputError&) {  // the text below says it
        }
        return "'" + text + "' must be a number " + (open ? "above " : "of at least ") + shortest(least);
      },
      std::string(open ? "> " : ">= ") + shortest(least)));
}

bool asked_for_quiet = false;

}  // namespace

Check at_least(double least) { return bounded(least, false); }
Check above(double least) { return bounded(least, true); }
Check in_range(int least, int most) { return shared(CLI::Range(least, most)); }
Check in_range(double least, double most) { return shared(CLI::Range(least, most)); }
Check one_of(std::vector<std::string> texts) { return shared(CLI::IsMember(std::move(texts))); }
Check nonnegative() { return shared(CLI::NonNegativeNumber); }
Check nonexistent_path() { return shared(CLI::NonexistentPath); }

Option* Option::required() {
  option_->required();
  return this;
}

Option* Option::capture_default_str() {
  option_->capture_default_str();
  return this;
}

Option* Option::check(const Check& check) {
  option_->check(*check);
  return this;
}

Option* Option::delimiter(char delimiter) {
  option_->delimiter(delimiter);
  return this;
}

Option* Option::expected(int count) {
  option_->expected(count);
  return this;
}

Option* Option::allow_extra_args(bool allow) {
  option_->allow_extra_args(allow);
  return this;
}

Option* Option::needs(const Option* other) {
  option_->needs(other->option_);
  return this;
}

Option* Option::excludes(const Option* other) {
  option_->excludes(other->option_);
  return this;
}

Option* Option::group(const std::string& name) {
  option_->group(name);
  return this;
}

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : app_(std::make_unique<CLI::App>(description, name)) {}
CommandLine::~CommandLine() = default;

template <class Value>
Option* CommandLine::add_option(const std::string& name, Value& value, const std::string& help) {
  return &options_.emplace_back(app_->add_option(name, value, help));
}

template Option* CommandLine::add_option(const std::string&, std::string&, const std::string&);
template Option* CommandLine::add_option(const std::string&, double&, const std::string&);
template Option* CommandLine::add_option(const std::string&, int&, const std::string&);
template Option* CommandLine::add_option(const std::string&, long&, const std::string&);
template Option* CommandLine::add_option(const std::string&, unsigned&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::size_t&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::vector<double>&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::vector<int>&, const std::string&);
template Option* CommandLine::add_option(const std::string&, std::vector<long>&, const std::string&);

Option* CommandLine::add_flag(const std::string& name, bool& value, const std::string& help) {
  return &options_.emplace_back(app_->add_flag(name, value, help));
}

Option* CommandLine::add_report(const std::string& name, std::function<std::string()> text,
                                const std::string& help) {
  const auto report = [text = std::move(text)] {
    std::cout << text();
    throw CLI::Success();
  };
  return &options_.emplace_back(app_->add_flag_callback(name, report, help)->trigger_on_parse());
}

void CommandLine::footer(const std::string& text) { app_->footer(text); }
void CommandLine::footer(std::function<std::string()> text) { app_->footer(std::move(text)); }
std::size_t CommandLine::count(const std::string& name) const { return app_->count(name); }
std::string CommandLine::name() const { return app_->get_name(); }

bool CommandLine::quiet() { return asked_for_quiet; }

namespace {

/// An option that the command does not have is more worth telling than one that is missing: it may be that
/// one, misspelt. Empty where there is none.
std::string unknown_option(const CLI::ParseError& error, const std::vector<std::string>& remaining) {
  if (!dynamic_cast<const CLI::RequiredError*>(&error)) return "";
  for (const std::string& word : remaining)
    if (word.starts_with("-") && word.size() > 1)
      return "The following argument was not expected: " + word + "; besides, " + error.what();
  return "";
}

}  // namespace

int CommandLine::parse(int argc, char** argv, const std::string& version) {
  app_->set_version_flag("--version", version);
  app_->add_flag("--quiet", asked_for_quiet, "tell nothing of the progress");
  app_->get_formatter()->column_width(34);
  try {
    app_->parse(argc, argv);
    return -1;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app_->exit(e);  // --help and --version
    const std::string unknown = unknown_option(e, app_->remaining());
    std::cerr << name() + ": error: " + printable(unknown.empty() ? e.what() : unknown) + " (see " + name() +
                     " --help)\n";
    return 2;
  }
}

}  // namespace cleft
