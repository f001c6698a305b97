// What a failing test case leaves behind: the command that runs it alone, and the pictures that it compared.
#pragma once

namespace tests {

/// To be called by main(): a listener of Catch does the rest. A case that fails prints its command, and each assertion
/// that fails writes the pair of pictures that was compared last, if any was since the case or the last failure began,
/// as N-got.png, N-wanted.png and N-difference.png into the folder $TYNDALL_FAILED_DIR (failed/ in the build folder)
/// under the name of the case and its context. The folder goes when the case passes.
void reportFailures();

} // namespace tests
