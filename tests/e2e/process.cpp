#include "tests/e2e/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <sstream>

extern char** environ;

namespace cartwright::test {
namespace {

namespace fs = std::filesystem;

constexpr int kReadyWithin_ms = 30000;

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Scratch::Scratch() {
  static std::atomic<int> count{0};
  directory_ = fs::temp_directory_path() /
               ("cartwright_e2e_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
  fs::create_directories(directory_);
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
}

void Scratch::put(const std::string& name, const std::string& text) const {
  fs::create_directories((directory_ / name).parent_path());
  std::ofstream(directory_ / name, std::ios::binary) << text;
}

Finished run(const std::string& program, const std::vector<std::string>& arguments) {
  const Scratch output;
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kCreate = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.text("out").c_str(), kCreate, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, output.text("err").c_str(), kCreate, 0600);
  pid_t process = -1;
  const int error =
      ::posix_spawnp(&process, program.c_str(), &actions, nullptr, pointers(words).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {-1, "", program + " cannot be started"};
  Finished finished;
  finished.status = wait_for(process);
  finished.out = content(output / "out");
  finished.err = content(output / "err");
  return finished;
}

Finished cartwright(const std::vector<std::string>& arguments) {
  return run(CARTWRIGHT_PROGRAM, arguments);
}

Daemon::Daemon(const std::string& rig, const std::string& simulation) {
  directory_.put("rig.toml",
                 "[rig]\nname = \"test cart\"\nkind = \"simulated\"\nsample_rate_hz = 1000\n"
                 "encoder_resolution_m = 2.275e-5\nvoltage_limit_V = 12.0\ntravel_m = [-0.4, 0.4]\n" +
                     rig + "\n[simulation]\nmodel = \"cart.toml\"\n" + simulation + "\n");
  directory_.put("cart.toml",
                 "[model]\nvoltage_gain_m_per_s2_V = 1.9\n[model.viscous_friction]\ncoefficient_per_s = 5.0\n"
                 "[model.coulomb_friction]\nlevel_m_per_s2 = 0.5\n");
  int pipe[2] = {-1, -1};
  if (::pipe2(pipe, O_CLOEXEC) != 0) return;
  output_ = pipe[0];
  std::vector<std::string> words = {CARTWRIGHTD_PROGRAM, "--rig",  directory_.text("rig.toml"),
                                    "--virtual",         "--port", "0"};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  ::posix_spawn(&process_, words[0].c_str(), &actions, nullptr, pointers(words).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);

  std::string line;
  pollfd waiting{output_, POLLIN, 0};
  while (line.find('\n') == std::string::npos && ::poll(&waiting, 1, kReadyWithin_ms) > 0) {
    char byte = 0;
    if (::read(output_, &byte, 1) != 1) return;
    line += byte;
  }
  // "cartwrightd: ready on 127.0.0.1:PORT, ..."
  const auto at = line.find("ready on ");
  const auto colon = at == std::string::npos ? at : line.find(':', at);
  if (colon != std::string::npos) port_ = std::atoi(line.c_str() + colon + 1);
}

int Daemon::stop() {
  if (process_ <= 0) return -1;
  ::kill(process_, SIGTERM);
  const int status = wait_for(process_);
  process_ = -1;
  return status;
}

Daemon::~Daemon() {
  stop();
  if (output_ >= 0) ::close(output_);
}

Finished Daemon::device(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), "device");
  arguments.insert(arguments.end(), {"--port", std::to_string(port_)});
  return cartwright(arguments);
}

}  // namespace cartwright::test
