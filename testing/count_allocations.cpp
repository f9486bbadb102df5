// Counts the calls of a thread to malloc, calloc, realloc and their aligned kin, whoever makes them
// (operator new and Eigen end there too): linking this file puts the counting functions in the
// place of the C library's. `check_task` and the tests ask for the count.

#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)

// The sanitizer's allocator stays in place, or it would see no errors; it tells of each call.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(const volatile void*,
                                                                             std::size_t),
                                                         void (*free_hook)(const volatile void*));

namespace {

thread_local std::size_t g_count = 0;

void count_malloc(const volatile void*, std::size_t) { ++g_count; }
void ignore_free(const volatile void*) {}

[[maybe_unused]] const int kInstalled =
    __sanitizer_install_malloc_and_free_hooks(count_malloc, ignore_free);

}  // namespace

#else

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

#endif

/// Of this thread so far.
extern "C" long surefoot_count_allocations() { return static_cast<long>(g_count); }
