// SPDX-License-Identifier: MIT
// The requests of a page to its virtual drive, one a line, with their answers: for a comparison with the browser.
#include <iostream>
#include <string>

extern "C" const char *sdre_drive_answer(const char *request);

int main()
{
    for (std::string line; std::getline(std::cin, line);) {
        std::string answer = sdre_drive_answer(line.c_str());
        while (!answer.empty() && answer.back() == '\n') {
            answer.pop_back();
        }
        std::cout << answer << '\n';
    }
    return 0;
}
