// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHelperProcess_h
#define tippHelperProcess_h

#include "Files/SharedMemory.h"
#include "vtkTIPPIOModule.h"

#include <functional>
#include <stdexcept>
#include <string>

#include <sys/types.h>

namespace tipp
{

/// Thrown if a helper process has ended or has not answered. what() says which, without a file.
class VTKTIPPIO_EXPORT HelperEnded : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
  ~HelperEnded() override;
};

/// A child process that answers requests one after another, for libraries that damaged files may
/// crash or hang. It is ended with the object, and ends by itself with this process. Threads may
/// not use the object concurrently.
class VTKTIPPIO_EXPORT HelperProcess
{
public:
  /// Answers a request in the helper, where it may also fill the memory. What it throws is thrown
  /// by receive(), as an IOError with the same message.
  using Answer = std::function<std::string(const std::string& request, SharedMemory& memory)>;

  /// An answer may take `cpuSeconds` of a processor. Throws IOError if no process can be started.
  explicit HelperProcess(Answer answer, int cpuSeconds = 15);
  ~HelperProcess();
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;

  /// Sends a request and returns. The helper works while this process does something else.
  void send(const std::string& request);
  /// Waits for the answer to the oldest request that has none, and returns it. Calls poll(). Throws
  /// IOError, HelperEnded.
  std::string receive();
  /// For an Answer: allows it so much work from now on.
  static void limitWork(int cpuSeconds);
  std::string ask(const std::string& request)
  {
    this->send(request);
    return this->receive();
  }

  /// What the last answer left in the memory: exactly `bytes`. Valid until the next send(). Throws
  /// HelperEnded if there are less.
  const char* memory(std::size_t bytes) { return this->Memory.map(bytes); }

private:
  [[noreturn]] void run(const Answer& answer, int cpuSeconds, int parentSocket);
  [[noreturn]] void reportEnd();
  void end();
  void waitForAnswer();

  SharedMemory Memory;
  int Socket = -1;
  pid_t Child = -1;
};

} // namespace tipp

#endif
