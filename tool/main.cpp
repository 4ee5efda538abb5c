// SPDX-License-Identifier: GPL-3.0-or-later
// The command line tool: translates the command line and the errors of the core, nothing else.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <exception>
#include <new>

#include "commands.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/version.h"

namespace {

enum ExitStatus { kDone = 0, kCouldNot = 1, kUsage = 2, kInterrupted = 130 };

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

// A second Ctrl-C ends the program at once.
void interrupt_on_signal() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int fail(ExitStatus status, const char* why) {
  std::fprintf(stderr, "ga_symmetry: %s\n", why);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace ga_symmetry;
  CLI::App app("Intrinsic symmetry of triangle meshes: for every vertex its partner on the other side, in any pose",
               "ga_symmetry");
  app.set_version_flag("--version", "ga_symmetry " GA_SYMMETRY_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Example:\n  ga_symmetry find body.ply -o body.csv\n`ga_symmetry COMMAND --help` lists a command's options.");
  tool::Run run;
  for (const auto add : {tool::add_find, tool::add_pairs, tool::add_axis, tool::add_mirror, tool::add_asymmetry,
                         tool::add_samples, tool::add_score})
    add(app, run);
#ifdef GA_SYMMETRY_COMPARISON
  tool::add_compare(app, run);
#endif
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }

  interrupt_on_signal();
  signal(SIGCHLD, SIG_DFL);  // ignored, as some parents leave it, it hides how a child ended
  signal(SIGXFSZ, SIG_IGN);  // a file that must not grow on is an error like a full disk
  Context context;
  context.cancel = &interrupted;
  try {
    run(context);
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw FileError("cannot write to the standard output: is the disk full?");
  } catch (const CLI::ParseError& error) {
    return fail(kUsage, error.what());
  } catch (const Cancelled&) {
    return fail(kInterrupted, "interrupted, nothing was written");
  } catch (const tool::Interrupted& error) {
    return fail(kInterrupted, error.what());
  } catch (const InvalidOption& error) {
    return fail(kUsage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kCouldNot, "out of memory");
  } catch (const std::exception& error) {
    return fail(kCouldNot, error.what());
  }
  return kDone;
}
