// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a program whose calls of the system that write in a folder are counted, and one of them (or
// all that take space from it on) answered with an error instead of done, as by a full or failing
// disk. The kernel asks this program about each call (seccomp_unotify(2), Linux 5.5 or newer):
// nothing that the C library or HDF5 does passes by.
//   fail_call FOLDER LOG CALL[+] ERROR PROGRAM [ARGUMENT]...
//     CALL: "NUMBER NAME PATH", a line of LOG; none; every; with + all that take space fail from
//     there
//       on (EROFS: all)
//     ERROR: ENOSPC, EIO, EROFS
// LOG gets a line a call: its number among those of its name on its path (that of all calls would
// depend on how often the clock had a program tell its progress), its name, the path, and FAILED
// where it was. Answers what the program does, 128 + the signal that ended it, 125 if it cannot be
// run, 77 if the kernel cannot do this.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <map>
#include <poll.h>
#include <string>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int cannot_run = 125, not_here = 77;

#if defined(__x86_64__)
constexpr unsigned machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned machine = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned machine = 0;
#endif

/// What a call writes to: a descriptor, or a path, whose places among its arguments follow.
struct Call {
  const char* name;
  int descriptor = -1; ///< of the file, or of the folder that the path is relative to
  int path = -1;
  int flags = -1;          ///< of an open
  bool takes_space = true; ///< what a full disk answers with an error
};

const std::map<int, Call>& calls() {
  static const std::map<int, Call> table{
      {SYS_write, {"write", 0}},
      {SYS_writev, {"writev", 0}},
      {SYS_pwrite64, {"pwrite", 0}},
      {SYS_pwritev, {"pwritev", 0}},
      {SYS_ftruncate, {"ftruncate", 0}},
      {SYS_fallocate, {"fallocate", 0}},
      {SYS_fsync, {"fsync", 0}},
      {SYS_fdatasync, {"fdatasync", 0}},
      {SYS_copy_file_range, {"copy_file_range", 2}},
      {SYS_sendfile, {"sendfile", 0}},
      {SYS_close, {.name = "close", .descriptor = 0, .takes_space = false}},
      {SYS_openat, {"open", 0, 1, 2}},
      {SYS_mkdirat, {"mkdir", 0, 1}},
      {SYS_renameat, {"rename", 2, 3}},
      {SYS_renameat2, {"rename", 2, 3}},
      {SYS_unlinkat, {"unlink", 0, 1, -1, false}},
#ifdef SYS_open // older calls that newer machines do without
      {SYS_open, {"open", -1, 0, 1}},
      {SYS_creat, {"open", -1, 0}},
      {SYS_mkdir, {"mkdir", -1, 0}},
      {SYS_rename, {"rename", -1, 1}},
      {SYS_unlink, {"unlink", -1, 0, -1, false}},
      {SYS_rmdir, {"rmdir", -1, 0, -1, false}},
#endif
  };
  return table;
}

[[noreturn]] void end(int code, const char* what) {
  std::fprintf(stderr, "fail_call: %s: %s\n", what, std::strerror(errno));
  _exit(code);
}

/// Has the kernel ask about the calls above; the descriptor that it asks at.
int ask_about_calls() {
  std::vector<sock_filter> filter{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, machine, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
  };
  for (const auto& [number, call] : calls()) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  if (machine == 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
  return static_cast<int>(
      syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER, &program));
}

union Control {
  char bytes[CMSG_SPACE(sizeof(int))];
  cmsghdr aligned;
};

msghdr message_of(Control& control, iovec& byte) {
  msghdr message{};
  message.msg_iov = &byte;
  message.msg_iovlen = 1;
  message.msg_control = control.bytes;
  message.msg_controllen = sizeof(control.bytes);
  return message;
}

void send_descriptor(int socket, int descriptor) {
  char none = 0;
  iovec byte{&none, 1};
  Control control{};
  const msghdr message = message_of(control, byte);
  cmsghdr* head = CMSG_FIRSTHDR(&message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(head), &descriptor, sizeof(int));
  if (sendmsg(socket, &message, 0) != 1) end(cannot_run, "sendmsg");
}

int receive_descriptor(int socket) {
  char none = 0;
  iovec byte{&none, 1};
  Control control{};
  msghdr message = message_of(control, byte);
  if (recvmsg(socket, &message, MSG_CMSG_CLOEXEC) != 1) return -1;
  const cmsghdr* head = CMSG_FIRSTHDR(&message);
  if (!head || head->cmsg_type != SCM_RIGHTS) return -1;
  int descriptor = -1;
  std::memcpy(&descriptor, CMSG_DATA(head), sizeof(int));
  return descriptor;
}

std::string process(unsigned pid, const std::string& what) {
  return "/proc/" + std::to_string(pid) + "/" + what;
}

std::string link(const std::string& path) {
  std::error_code error;
  const fs::path to = fs::read_symlink(path, error);
  return error ? "" : to.string();
}

/// Text of the process, at an address of its memory.
std::string text_at(unsigned pid, unsigned long long address) {
  std::ifstream memory(process(pid, "mem"), std::ios::binary);
  memory.seekg(static_cast<std::streamoff>(address));
  std::string text;
  std::getline(memory, text, '\0');
  return text;
}

/// The path that a call writes to; empty if it writes none.
std::string path_of(const Call& call, const seccomp_notif& asked) {
  const auto* arguments = asked.data.args;
  const int descriptor =
      call.descriptor < 0 ? AT_FDCWD : static_cast<int>(arguments[call.descriptor]);
  const auto of_descriptor = [&] {
    return link(
        process(asked.pid, descriptor == AT_FDCWD ? "cwd" : "fd/" + std::to_string(descriptor)));
  };
  const auto writes = [](unsigned long long flags) {
    return (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0;
  };
  if (call.flags >= 0 && !writes(arguments[call.flags])) return "";
  if (call.path >= 0)
    return (fs::path(of_descriptor()) / text_at(asked.pid, arguments[call.path]))
        .lexically_normal()
        .string();
  std::ifstream info(process(asked.pid, "fdinfo/" + std::to_string(descriptor)));
  unsigned long long flags = 0;
  for (std::string word; info >> word;)
    if (word == "flags:") info >> std::oct >> flags;
  return writes(flags) ? of_descriptor() : "";
}

struct Arguments {
  std::string folder;
  const char* log;
  std::string call; ///< as a line of the log
  bool onwards;
  int error;
};

/// Whether a call waits for an answer; false when no process is left that could make one.
bool is_asked(int listener) {
  pollfd asks{listener, POLLIN, 0};
  while (poll(&asks, 1, -1) < 0 && errno == EINTR)
    ;
  return (asks.revents & POLLIN) != 0;
}

/// Answers the kernel until no process is left that it could ask about.
void answer(int listener, const Arguments& to) {
  std::FILE* log = std::fopen(to.log, "w");
  if (!log) end(cannot_run, to.log);
  std::map<std::string, long> counts;
  bool reached = false;
  while (is_asked(listener)) {
    seccomp_notif asked{};
    if (ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &asked) != 0) {
      if (errno == EINTR || errno == ENOENT) continue; // a signal was faster: it will ask again
      break;
    }
    const Call& call = calls().at(asked.data.nr);
    const std::string path = path_of(call, asked);
    seccomp_notif_resp reply{};
    reply.id = asked.id;
    reply.flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE;
    if (path == to.folder || path.starts_with(to.folder + "/")) {
      const std::string what =
          std::string(call.name) + " " +
          (path.size() > to.folder.size() ? path.substr(to.folder.size() + 1) : ".");
      const std::string line = std::to_string(++counts[what]) + " " + what;
      const bool here = line == to.call || (!reached && to.call == "every");
      const bool later = reached && to.onwards && (call.takes_space || to.error == EROFS);
      reached = reached || here;
      if (here || later) {
        reply.flags = 0;
        reply.error = -to.error;
      }
      std::fprintf(log, "%s%s\n", line.c_str(), here || later ? " FAILED" : "");
    }
    ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &reply); // fails if the process was killed meanwhile
  }
  std::fclose(log);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 6) {
    std::fputs("fail_call FOLDER LOG CALL[+] ERROR PROGRAM [ARGUMENT]...\n", stderr);
    return cannot_run;
  }
  const std::map<std::string, int> errors{{"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EROFS", EROFS}};
  std::string call = argv[3];
  const bool onwards = call.ends_with("+");
  if (onwards) call.pop_back();
  const Arguments arguments{fs::absolute(argv[1]).lexically_normal().string(), argv[2], call,
                            onwards, errors.at(argv[4])};
  int sockets[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) end(cannot_run, "sockets");
  const pid_t child = fork();
  if (child < 0) end(cannot_run, "fork");
  if (child == 0) {
    const int listener = ask_about_calls();
    if (listener < 0) end(not_here, "the kernel does not ask about calls of the system");
    send_descriptor(sockets[1], listener);
    fcntl(listener, F_SETFD, FD_CLOEXEC);
    execvp(argv[5], argv + 5);
    end(cannot_run, argv[5]);
  }
  close(sockets[1]);
  const int listener = receive_descriptor(sockets[0]);
  if (listener >= 0) answer(listener, arguments);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    ;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
