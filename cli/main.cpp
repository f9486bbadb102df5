#include "cli/program.hpp"

int main(int argc, char** argv) { return surefoot::run_program(argc, argv); }
