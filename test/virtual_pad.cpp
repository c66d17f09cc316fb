// Preloaded into a program that looks for game controllers, it plugs in SDL's own virtual one. Its stick and buttons come by datagrams
// to the socket $VIRTUAL_PAD: four floats, left and forward in [-1, 1], then 1 for each of the buttons A and Start that is down; or one letter:
// b its motion sensor begins to stream, f its link freezes, u it is unplugged, p it is plugged in again. What the motors are told goes to $VIRTUAL_PAD.motors: two
// floats, left and right in [0, 1].
#include <SDL.h>
#include <dlfcn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

namespace {

int g_socket = -1;
std::atomic<bool> g_streams{false};
std::atomic<SDL_JoystickID> g_pad{-1};

/// SDL's function, of the program's own library.
#define SDL(name) reinterpret_cast<decltype(&name)>(::dlsym(RTLD_NEXT, #name))

sockaddr_un address(const std::string& path) {
  sockaddr_un found = {};
  found.sun_family = AF_UNIX;
  std::strncpy(found.sun_path, path.c_str(), sizeof(found.sun_path) - 1);
  return found;
}

int on_rumble(void* motors, Uint16 left, Uint16 right) {
  const std::array<float, 2> forces = {static_cast<float>(left) / 65535.0F, static_cast<float>(right) / 65535.0F};
  ::sendto(g_socket, forces.data(), sizeof(forces), MSG_DONTWAIT, static_cast<const sockaddr*>(motors), sizeof(sockaddr_un));
  return 0;
}

void stream() {
  for (const auto push = SDL(SDL_PushEvent);; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    SDL_Event event = {};
    event.csensor.type = SDL_CONTROLLERSENSORUPDATE;
    event.csensor.which = g_pad;
    event.csensor.sensor = SDL_SENSOR_GYRO;
    if (g_streams) push(&event);
  }
}

void unplug() {
  for (int index = SDL(SDL_NumJoysticks)(); --index >= 0;)
    if (SDL(SDL_JoystickGetDeviceInstanceID)(index) == g_pad) SDL(SDL_JoystickDetachVirtual)(index);
}

SDL_Joystick* attach() {
  static sockaddr_un motors = address(std::getenv("VIRTUAL_PAD") + std::string(".motors"));
  SDL_VirtualJoystickDesc desc = {};
  desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
  desc.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
  desc.naxes = SDL_CONTROLLER_AXIS_MAX;
  desc.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
  desc.name = "virtual pad";
  desc.userdata = &motors;
  desc.Rumble = &on_rumble;
  SDL_Joystick* const pad = SDL(SDL_JoystickOpen)(SDL(SDL_JoystickAttachVirtualEx)(&desc));
  if (pad != nullptr) g_pad = SDL(SDL_JoystickInstanceID)(pad);
  return pad;
}

void obey(SDL_Joystick* pad) {
  std::thread(stream).detach();
  const auto set_axis = SDL(SDL_JoystickSetVirtualAxis);
  const auto set_button = SDL(SDL_JoystickSetVirtualButton);
  std::array<float, 4> hand{};
  for (ssize_t size = 0; (size = ::recv(g_socket, hand.data(), sizeof(hand), 0)) > 0;) {
    if (size == 1) {
      const char letter = *reinterpret_cast<const char*>(hand.data());
      g_streams = letter == 'b';
      if (letter == 'u') unplug();
      if (letter == 'p') pad = attach();
      continue;
    }
    set_axis(pad, SDL_CONTROLLER_AXIS_LEFTX, static_cast<Sint16>(-32767.0F * hand[0]));
    set_axis(pad, SDL_CONTROLLER_AXIS_LEFTY, static_cast<Sint16>(-32767.0F * hand[1]));
    set_button(pad, SDL_CONTROLLER_BUTTON_A, hand[2] > 0.0F ? 1 : 0);
    set_button(pad, SDL_CONTROLLER_BUTTON_START, hand[3] > 0.0F ? 1 : 0);
  }
}

void plug_in(const std::string& path) {
  const sockaddr_un own = address(path);
  ::unlink(path.c_str());  // of a program that was killed
  g_socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (::bind(g_socket, reinterpret_cast<const sockaddr*>(&own), sizeof(own)) != 0) return;
  if (SDL_Joystick* const pad = attach(); pad != nullptr) std::thread(obey, pad).detach();
}

}  // namespace

extern "C" SDL_bool SDL_GameControllerHasSensor(SDL_GameController*, SDL_SensorType sensor) {
  return sensor == SDL_SENSOR_GYRO ? SDL_TRUE : SDL_FALSE;
}
extern "C" int SDL_GameControllerSetSensorEnabled(SDL_GameController*, SDL_SensorType, SDL_bool) { return 0; }

extern "C" int SDL_InitSubSystem(Uint32 flags) {
  const int result = SDL(SDL_InitSubSystem)(flags);
  const char* const path = std::getenv("VIRTUAL_PAD");
  if (result == 0 && (flags & SDL_INIT_GAMECONTROLLER) != 0 && path != nullptr && g_socket < 0) plug_in(path);
  return result;
}
