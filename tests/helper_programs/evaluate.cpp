// A child for the tests of `rugosa optimise`: evaluates genomes by the function that its argument names.

#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

int main(int, char** words) {
    const std::string function = words[1];
    int lines = 0;
    for (std::string line; std::getline(std::cin, line);) {
        if (function == "dies" && ++lines > 30) {
            std::cerr << "out of ink\n";
            return 7;
        }
        std::replace_if(
            line.begin(), line.end(), [](char c) { return std::string("{}[]:,").find(c) != std::string::npos; }, ' ');
        std::istringstream in(line); // "id" 1 "genes" 0.5 1
        std::string id, word;
        in >> word >> id >> word;
        std::vector<double> x;
        for (double gene; in >> gene;) x.push_back(gene);
        in.clear();
        in >> word; // the first gene that is a word
        double sum = 0, squares = 0, steps = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            sum += x[i];
            squares += x[i] * x[i];
            steps += i > 0 && x[i] == x[i - 1] + 1;
        }
        std::cout.precision(17);
        std::cout << "{\"id\":" << id << ",\"objectives\":[";
        if (function == "sphere")
            std::cout << squares << "]}";
        else if (function == "order") // number of neighbours that follow each other
            std::cout << steps << "]}";
        else if (function == "schaffer") // whose front is 0 <= x <= 2
            std::cout << x[0] * x[0] << "," << (x[0] - 2) * (x[0] - 2) << "]}";
        else if (function == "mixed") // best at 7, 0.5 and "b"
            std::cout << (word == "\"b\"" ? 1 : 0) - (x[0] - 7) * (x[0] - 7) - (x[1] - 0.5) * (x[1] - 0.5) << "]}";
        else if (function == "held") // x where x <= 0.25
            std::cout << x[0] << "],\"violation\":" << x[0] - 0.25 << "}";
        else
            std::cout << sum << "]}";
        std::cout << std::endl;
    }
}
