#include "particle/io/frame_queue.hpp"

#include <chrono>
#include <csignal>

namespace surge {

namespace {

/// While it lives, threads that are started ignore all signals: Ctrl-C is for the main thread, and
/// must not cut a write short.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace

FrameQueue::FrameQueue(FrameWriter writer)
    : FrameQueue([writer = std::move(writer)](const Snapshot& s) mutable { writer.write(s); }) {}

FrameQueue::FrameQueue(Write write, std::size_t capacity)
    : write_(std::move(write)), capacity_(capacity) {
  const SignalsBlocked blocked;
  thread_ = std::thread([this] { work(); });
}

FrameQueue::~FrameQueue() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameQueue::push(Snapshot snapshot) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return error_ || waiting_.size() < capacity_; });
  throw_error();
  waiting_.push_back(std::move(snapshot));
  changed_.notify_all();
}

void FrameQueue::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return error_ || waiting_.empty(); });
  throw_error();
}

void FrameQueue::throw_error() {
  if (error_) std::rethrow_exception(error_);
}

void FrameQueue::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    write_next(lock);
    if (error_) return;
  }
}

void FrameQueue::write_next(std::unique_lock<std::mutex>& lock) {
  // Others only append meanwhile, which moves no element of a deque.
  const Snapshot& next = waiting_.front();
  lock.unlock();
  const auto start = std::chrono::steady_clock::now();
  std::exception_ptr error;
  try {
    write_(next);
  } catch (...) {
    error = std::current_exception();
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  busy_s_.store(busy_s_.load() + spent.count());  // only this thread stores
  if (!error) written_.fetch_add(1);
  lock.lock();
  error_ = error;
  waiting_.pop_front();
  changed_.notify_all();
}

}  // namespace surge
