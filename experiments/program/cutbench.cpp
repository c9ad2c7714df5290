#include "experiments/program/command_line.h"

int main(int argc, char** argv) { return cutbench::command_line(argc, argv); }
