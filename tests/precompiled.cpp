// The precompiled headers of the tests belong to a program, and a program has a main function.
int main() { return 0; }
