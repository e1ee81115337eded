// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTaskMessages_h
#define tippTaskMessages_h

#include "Distributed/LeafWorkers.h"
#include "Messages/Bytes.h"
#include "Messages/Postbox.h"

namespace tipp
{

/// Tasks and their results between ranks. What is damaged throws std::runtime_error.
Bytes pack(const Task& task);
Bytes pack(const TaskResult& result);
Task unpackTask(const Message& message);
TaskResult unpackResult(const Message& message);

} // namespace tipp

#endif
