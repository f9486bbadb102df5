#include "tests/support/malloc_counter.hpp"

#include <cerrno>

// glibc's own allocator under the names that are not replaced here.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

// Static storage of the thread: reading it never allocates.
__attribute__((tls_model("initial-exec"))) thread_local std::size_t g_count = 0;

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  ++g_count;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  ++g_count;
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  ++g_count;
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  ++g_count;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++g_count;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  ++g_count;
  *result = __libc_memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}

}  // extern "C"

namespace surefoot::test {

MallocCounter::MallocCounter() : start_(g_count) {}

std::size_t MallocCounter::count() const { return g_count - start_; }

}  // namespace surefoot::test
