// Starts a program as sandboxes of others do that allow no sandbox inside them: under a filter that
// refuses seccomp(2), unshare and new namespaces.
//   raks_refuse_calls prctl|no-prctl PROGRAM ARGUMENT...    prctl: filters by prctl(2) are refused,
//   too
#include <errno.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <initializer_list>

namespace {

bool refuse(scmp_filter_ctx filter, bool is_prctl_refused) {
    bool is_refused = true;
    for (const int call : {SCMP_SYS(seccomp), SCMP_SYS(unshare), SCMP_SYS(setns)}) {
        is_refused = is_refused && seccomp_rule_add(filter, SCMP_ACT_ERRNO(EPERM), call, 0) == 0;
    }
    // The C library goes on with clone, whose flags a filter can see.
    is_refused =
        is_refused && seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) == 0;
    for (const int each : {CLONE_NEWUSER, CLONE_NEWNS, CLONE_NEWPID, CLONE_NEWNET}) {
        const auto flag = static_cast<scmp_datum_t>(each);
        is_refused =
            is_refused && seccomp_rule_add(filter,
                                           SCMP_ACT_ERRNO(EPERM),
                                           SCMP_SYS(clone),
                                           1,
                                           scmp_arg_cmp{0, SCMP_CMP_MASKED_EQ, flag, flag}) == 0;
    }
    if (is_prctl_refused) {
        is_refused =
            is_refused && seccomp_rule_add(filter,
                                           SCMP_ACT_ERRNO(EPERM),
                                           SCMP_SYS(prctl),
                                           1,
                                           scmp_arg_cmp{0, SCMP_CMP_EQ, PR_SET_SECCOMP, 0}) == 0;
    }
    return is_refused && seccomp_load(filter) == 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        return 2;
    }
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
    if (filter == nullptr || !refuse(filter, std::strcmp(argv[1], "prctl") == 0)) {
        std::fputs("refuse_calls: this kernel has no filter of system calls\n", stderr);
        return 77;
    }
    seccomp_release(filter);
    execv(argv[2], argv + 2);
    return 1;
}
