// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/TaskMessages.h"

namespace tipp
{

Bytes pack(const Task& task)
{
  ByteWriter writer;
  writer.reserve(sizeof(Task) + task.Vertices.size() * sizeof(PlainVertex));
  writer.value(task.Area);
  writer.value(task.Partition);
  writer.array(task.Vertices);
  return writer.take();
}

Bytes pack(const TaskResult& result)
{
  ByteWriter writer;
  writer.value(result.Area);
  writer.value(result.Partition);
  writer.value(result.WorkerVertices);
  writer.value(result.Seconds);
  result.Seams.write(writer);
  return writer.take();
}

Task unpackTask(const Message& message)
{
  ByteReader reader(message.Content);
  Task task;
  task.Area = reader.value<std::int32_t>();
  task.Partition = reader.value<PartitionIndex>();
  reader.array(task.Vertices);
  return task;
}

TaskResult unpackResult(const Message& message)
{
  ByteReader reader(message.Content);
  TaskResult result;
  result.Area = reader.value<std::int32_t>();
  result.Partition = reader.value<PartitionIndex>();
  result.WorkerVertices = reader.value<std::int64_t>();
  result.Seconds = reader.value<double>();
  result.Seams = SeamGroups::read(reader);
  return result;
}

} // namespace tipp
