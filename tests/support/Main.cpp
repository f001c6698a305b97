namespace tests {
int runTests(int argc, char** argv); // RunTests.cpp
}

int main(int argc, char** argv) { return tests::runTests(argc, argv); }
