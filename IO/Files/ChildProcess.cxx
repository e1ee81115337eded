// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ChildProcess.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/Platform.h"

#include <cerrno>
#include <csignal>
#include <exception>

#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{

std::string runInChild(const std::function<std::string()>& work)
{
  constexpr char success = '+';
  constexpr char failure = '-';
  const int memory = openMemoryFile("tipp-result");
  if (memory < 0)
  {
    return work();
  }
  const OutputFile output(memory, "The result of a child process");
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0)
  {
    // This process' signal handlers wake a thread that the child does not have.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    endWithParent();
    if (getppid() != parent)
    {
      _exit(1);
    }
    try
    {
      char kind = success;
      std::string text;
      try
      {
        text = work();
      }
      catch (const std::exception& error)
      {
        kind = failure;
        text = error.what();
      }
      output.write(1, text.data(), text.size());
      output.write(0, &kind, 1); // last, because it shows that the result is complete
      _exit(0);                  // skips this process' own clean-up
    }
    catch (...)
    {
      _exit(1);
    }
  }
  if (child < 0)
  {
    return work(); // fork() failed: run in this process
  }
  int status = 0; // stays 0 if SIGCHLD is ignored
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  const InputFile input(pathOfDescriptor(memory));
  std::string result(std::size_t(input.size()), '\0');
  input.read(0, result.data(), result.size());
  const char kind = result.empty() ? '\0' : result.front();
  if (status != 0 || (kind != success && kind != failure))
  {
    throw IOError("A process that was to do a part of the work has ended early; try again.");
  }
  result.erase(0, 1);
  return kind == success ? result : throw IOError(result);
}

} // namespace tipp
