#include "program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "docent/apps/shared/laboratory_commands.h"

namespace docent {

namespace {

std::string program_for(const std::vector<std::string>& arguments) {
  const std::filesystem::path docent = docent_program();
  const auto& names = apps::kLaboratoryCommands;
  const bool is_laboratory =
      !arguments.empty() && std::find(names.begin(), names.end(), arguments.front()) != names.end();
  return is_laboratory ? docent.parent_path() / "docent-lab" : docent;
}

}  // namespace

std::filesystem::path docent_program() {
  const char* other = std::getenv("DOCENT_BINARY");  // as scripts/evaluate knows it
  return other != nullptr ? other : DOCENT_PROGRAM;
}

Program::Program(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) std::abort();
  std::vector<std::string> words{program_for(arguments)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    setenv("DOCENT_CACHE", cache_.path().c_str(), 1);
    execv(pointers[0], pointers.data());
    _exit(127);
  }
  close(ends[1]);
  output_ = ends[0];
  fcntl(output_, F_SETFL, O_NONBLOCK);
}

Program::~Program() {
  if (pid_ > 0) {
    kill(pid_, SIGTERM);
    if (wait(std::chrono::seconds{6}) == -1 && pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  close(output_);
}

void Program::signal(int number) const { kill(pid_, number); }

int Program::wait(std::chrono::duration<double> patience) {
  int status = 0;
  const bool has_ended = eventually(
      [&] {
        static_cast<void>(output());  // or it would wait for a reader
        return waitpid(pid_, &status, WNOHANG) == pid_;
      },
      patience);
  if (!has_ended) return -1;
  static_cast<void>(output());
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string Program::output() {
  std::array<char, 4096> buffer{};
  for (ssize_t count = 0; (count = read(output_, buffer.data(), buffer.size())) > 0;) {
    text_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text_;
}

bool Program::prints(const std::string& text, std::chrono::duration<double> patience) {
  return eventually([&] { return output().find(text) != std::string::npos; }, patience);
}

std::vector<pid_t> Program::children() const {
  std::ifstream file{"/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children"};
  std::vector<pid_t> all;
  for (pid_t child = 0; file >> child;) all.push_back(child);
  return all;
}

Finished run_program(const std::vector<std::string>& arguments) {
  Program program{arguments};
  const int code = program.wait();
  return {code, program.output()};
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "docent-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) std::abort();
  path_ = name;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}
std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
  std::ofstream{path_ / name} << content;
  return (path_ / name).string();
}

bool eventually(const std::function<bool()>& done, std::chrono::duration<double> patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
  return true;
}

bool is_running(pid_t pid) {
  std::ifstream file{"/proc/" + std::to_string(pid) + "/stat"};
  std::string number;
  std::string name;
  std::string state;
  return (file >> number >> name >> state) && state != "Z";
}

}  // namespace docent
