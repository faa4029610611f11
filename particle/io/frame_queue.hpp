#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "particle/io/snapshot.hpp"
#include "particle/io/vtk_writer.hpp"

namespace surge {

/// Writes frames in a thread of its own, in the order in which they come, while the solver goes on.
/// At most `capacity` snapshots exist at a time, the one that is being written among them: push()
/// waits for a place, so that a slow disk slows a run down but never fills its memory.
///
/// After an error nothing more is written; the next push() or finish() throws what the thread
/// caught.
class FrameQueue {
 public:
  using Write = std::function<void(const Snapshot&)>;

  explicit FrameQueue(FrameWriter writer);
  explicit FrameQueue(Write write, std::size_t capacity = 2);
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  /// Writes what is left. An error has nobody to go to any more: call finish() first.
  ~FrameQueue();

  void push(Snapshot snapshot);
  /// Returns when every frame is on the disk.
  void finish();

  /// Frames that are on the disk.
  [[nodiscard]] long written() const { return written_.load(); }
  /// Seconds that the thread has spent on writing.
  [[nodiscard]] double busy_s() const { return busy_s_.load(); }

 private:
  void work();
  void write_next(std::unique_lock<std::mutex>& lock);
  void throw_error();

  Write write_;
  std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Snapshot> waiting_;  ///< the first one is being written; it leaves when it is written
  std::exception_ptr error_;
  bool closing_ = false;
  std::atomic<double> busy_s_ = 0.0;
  std::atomic<long> written_ = 0;
  std::thread thread_;  // last: it uses the others
};

}  // namespace surge
