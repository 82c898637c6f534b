#include "engine/decode/confine.hpp"

#include <fcntl.h>
#include <poll.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>

namespace raks::engine {
namespace {

// What decoding needs. Receiving a descriptor is how the file comes.
constexpr int kAllowed[] = {SCMP_SYS(read),           SCMP_SYS(readv),
                            SCMP_SYS(pread64),        SCMP_SYS(lseek),
                            SCMP_SYS(fstat),          SCMP_SYS(close),
                            SCMP_SYS(poll),           SCMP_SYS(ppoll),
                            SCMP_SYS(sendmsg),        SCMP_SYS(recvmsg),
                            SCMP_SYS(munmap),         SCMP_SYS(mremap),
                            SCMP_SYS(madvise),        SCMP_SYS(brk),
                            SCMP_SYS(futex),          SCMP_SYS(sched_yield),
                            SCMP_SYS(clock_gettime),  SCMP_SYS(clock_nanosleep),
                            SCMP_SYS(nanosleep),      SCMP_SYS(gettimeofday),
                            SCMP_SYS(getrandom),      SCMP_SYS(getpid),
                            SCMP_SYS(gettid),         SCMP_SYS(rt_sigreturn),
                            SCMP_SYS(rt_sigprocmask), SCMP_SYS(restart_syscall),
                            SCMP_SYS(exit),           SCMP_SYS(exit_group)};

void limit(__rlimit_resource what, rlim_t most) {
    const rlimit value{most, most};
    static_cast<void>(setrlimit(what, &value));  // never raised, so never refused
}

// Bytes of address space in use; 0 where /proc is not there.
rlim_t memory_in_use() {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

bool allow_all(scmp_filter_ctx filter) {
    for (const int call : kAllowed) {
        if (seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) != 0) {
            return false;
        }
    }
    // Memory, but no new code in it.
    for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)}) {
        if (seccomp_rule_add(
                filter, SCMP_ACT_ALLOW, call, 1, SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)) != 0) {
            return false;
        }
    }
    // fstat() of glibc is this one with a flag.
    return seccomp_rule_add(filter,
                            SCMP_ACT_ALLOW,
                            SCMP_SYS(newfstatat),
                            1,
                            SCMP_A3(SCMP_CMP_EQ, AT_EMPTY_PATH)) == 0;
}

bool load_filter() {
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    const bool is_loaded = filter != nullptr && allow_all(filter) && seccomp_load(filter) == 0;
    seccomp_release(filter);
    return is_loaded;
}

}  // namespace

Confinement confine(std::uint64_t more_memory) {
    if (const rlim_t used = memory_in_use(); used > 0) {
        limit(RLIMIT_AS, used + more_memory);
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    static_cast<void>(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0));
    static_cast<void>(prctl(PR_SET_DUMPABLE, 0, 0, 0, 0));
    return load_filter() ? Confinement::whole : Confinement::without_filter;
}

// The kernel sends SIGIO, whose default is to end the process.
void end_with(int lifeline) {
    fcntl(lifeline, F_SETOWN, getpid());
    fcntl(lifeline, F_SETFL, fcntl(lifeline, F_GETFL) | O_ASYNC);
    pollfd look{lifeline, POLLIN, 0};
    if (poll(&look, 1, 0) > 0) {  // it was closed before
        _exit(0);
    }
}

}  // namespace raks::engine
