#include "common/parallel.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

namespace common {

namespace {

/// Starts this program again with passive waiting: the OpenMP runtime reads its environment only at load
/// time. Returns when that is impossible; the run is then slower, not wrong.
void restart_with_passive_waiting() {
    setenv("OMP_WAIT_POLICY", "passive", 1);
    std::ifstream stream("/proc/self/cmdline", std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    std::string line = text.str();
    std::vector<char*> words;
    for (std::size_t from = 0; from < line.size(); from = line.find('\0', from) + 1) {
        words.push_back(line.data() + from);
        if (line.find('\0', from) == std::string::npos) break;
    }
    words.push_back(nullptr);
    if (words.size() > 1) execv("/proc/self/exe", words.data());
}

}  // namespace

void use_threads(int count) {
    if (count > 1 && std::getenv("OMP_WAIT_POLICY") == nullptr) restart_with_passive_waiting();
    omp_set_dynamic(0);
    omp_set_num_threads(count);
}

}  // namespace common
