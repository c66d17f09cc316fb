// Preloaded into a program, it adds to the calendar time that the program reads the nanoseconds that the file $SET_CLOCK holds as eight
// bytes, now and whenever they change: as if somebody had set the computer's clock. The monotonic clock stays. A wait until a calendar
// time ends as it would on that clock; one that had begun before the clock was set is not changed.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>

#include <cstdint>
#include <cstdlib>

namespace {

constexpr time_t kCalendar = 1'000'000'000;  // s; a later time is one of the calendar, an earlier one of the monotonic clock
constexpr std::int64_t kSecond = 1'000'000'000;  // ns

std::int64_t set_by() {
  static const volatile std::int64_t* const ahead = [] {
    const char* const path = std::getenv("SET_CLOCK");
    const int file = path != nullptr ? ::open(path, O_RDONLY | O_CLOEXEC) : -1;
    void* const mapped = file < 0 ? MAP_FAILED : ::mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, file, 0);
    return mapped == MAP_FAILED ? nullptr : static_cast<const std::int64_t*>(mapped);
  }();
  return ahead != nullptr ? *ahead : 0;
}

timespec plus(const timespec& time, std::int64_t ahead) {
  const std::int64_t all = time.tv_sec * kSecond + time.tv_nsec + ahead;
  return {all / kSecond, all % kSecond};
}

template <typename F>
F next(F, const char* name) {
  return reinterpret_cast<F>(::dlsym(RTLD_NEXT, name));
}

timespec real(const timespec& wanted) {
  return wanted.tv_sec > kCalendar ? plus(wanted, -set_by()) : wanted;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static const auto system = next(&clock_gettime, "clock_gettime");
  const int result = system(clock, now);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) *now = plus(*now, set_by());
  return result;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  static const auto system = next(&gettimeofday, "gettimeofday");
  const int result = system(now, zone);
  if (result != 0) return result;
  const timespec ahead = plus({now->tv_sec, 1000 * now->tv_usec}, set_by());
  *now = {ahead.tv_sec, ahead.tv_nsec / 1000};
  return result;
}

time_t time(time_t* out) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) *out = now.tv_sec;
  return now.tv_sec;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  static const auto system = next(&pthread_cond_timedwait, "pthread_cond_timedwait");
  const timespec then = real(*until);
  return system(condition, mutex, &then);
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* until) {
  static const auto system = next(&pthread_cond_clockwait, "pthread_cond_clockwait");
  const timespec then = real(*until);
  return system(condition, mutex, clock, &then);
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  static const auto system = next(&clock_nanosleep, "clock_nanosleep");
  const timespec then = (flags & TIMER_ABSTIME) != 0 ? real(*time) : *time;
  return system(clock, flags, &then, left);
}

}  // extern "C"
